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
  std::vector<std::string> crops{};  ///< one per window
  std::string error_map{};           ///< for the reference the whole picture, reduced
};

/// A part of a picture, in pixels from its top left.
struct Window {
  std::string title{};
  int x = 0, y = 0, width = 0, height = 0;
};

/// What the details of all pictures have in common.
struct DetailLayout {
  std::vector<Window> windows{};  ///< the crops; empty before the first picture
  double top = 0;                 ///< radiance of the brightest colour of error maps
  double mean = 0;                ///< mean radiance of the reference
  int map_width = 0, map_height = 0;
  int thumbnail_width = 0, thumbnail_height = 0;
};

/// The visual part of a measurement: the same details of each picture, enlarged, and error maps.
class Details {
 public:
  explicit Details(render::Tone tone) : tone_(tone) {}

  /// Adds a picture. The first one determines the layout.
  void add(const render::Configuration& configuration, int samples, const render::Picture& picture,
           const render::ReferencePicture& reference);

  /// Arranges the pictures of a measurement's points in rows.
  void fill(Report& report) const;

  // The state, to save it and to restore it.
  const DetailLayout& layout() const noexcept { return layout_; }
  /// By name: "reference", and "sobol-…-samples-64".
  const std::map<std::string, PictureDetails>& pictures() const noexcept { return pictures_; }
  void restore(DetailLayout layout) { layout_ = std::move(layout); }
  void restore(const std::string& key, PictureDetails details) {
    pictures_[key] = std::move(details);
  }

 private:
  struct Shown {
    std::string title, key;
  };

  void choose_layout(const render::Picture& picture, const render::ReferencePicture& reference);
  std::string png(const render::Picture& picture) const;
  std::vector<std::string> crops_of(const render::Picture& picture) const;
  std::string error_map(const render::Picture& picture, const render::Picture& reference) const;
  void add_rows(Report& report, const std::string& title, std::vector<Shown> shown) const;

  render::Tone tone_;
  DetailLayout layout_;
  std::map<std::string, PictureDetails> pictures_;
};

}  // namespace sdlc::cli
