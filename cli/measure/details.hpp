#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "cli/report/report.hpp"
#include "render/image/tone.hpp"
#include "render/measure/measurement.hpp"
#include "render/measure/reference_error.hpp"

namespace sdlc::cli {

/// The PNG files that a report shows for one picture.
struct PictureDetails {
  std::string crop{};
  std::string map{};  ///< the error map; for the reference the whole picture; both reduced
};

/// What the details of all pictures have in common.
struct DetailLayout {
  double top = 0;                           ///< radiance of the brightest colour of error maps
  int map_width = 0, map_height = 0;        ///< 0 before the first picture
  int x = 0, y = 0, width = 0, height = 0;  ///< the crop, in pixels from the top left
};

/// The visual part of a measurement: error maps, and the noisiest area of each picture, enlarged.
class Details {
 public:
  explicit Details(const render::ToneMapping& mapping) : mapping_(mapping) {}

  /// Adds a picture. The first one determines the layout.
  void add(const render::Configuration& configuration, int samples, const render::Picture& picture,
           const render::ReferencePicture& reference);

  /// Arranges the pictures of a measurement's points in rows.
  void fill(Report& report) const;

  // The state, to save it and to restore it.
  const DetailLayout& layout() const noexcept { return layout_; }
  /// By name: "reference", and "sobol-…-samples-64".
  const std::map<std::string, PictureDetails>& pictures() const noexcept { return pictures_; }
  void restore(DetailLayout layout) { layout_ = layout; }
  void restore(const std::string& key, PictureDetails details) {
    pictures_[key] = std::move(details);
  }

 private:
  struct Shown {
    std::string title, key;
  };

  void choose_layout(const render::Picture& picture, const render::ReferencePicture& reference);
  std::string crop_of(const render::Picture& picture) const;
  std::string error_map(const render::Picture& errors) const;
  void add_rows(Report& report, const std::string& title, std::vector<Shown> shown) const;

  render::ToneMapping mapping_;
  DetailLayout layout_;
  std::map<std::string, PictureDetails> pictures_;
};

}  // namespace sdlc::cli
