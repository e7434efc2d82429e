#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cli/measure/json_types.hpp"
#include "cli/report/report.hpp"
#include "render/image/tone.hpp"
#include "render/measure/measurement.hpp"
#include "render/measure/reference_error.hpp"

namespace sdlc::cli {

/// The PNG files that a report shows of one picture.
struct PictureDetails {
  std::vector<std::string> crops;  ///< one a window
  std::string error_map;           ///< of the reference all of it, small
};

/// A part of a picture, in pixels from its top left.
struct Window {
  std::string title{};
  int x = 0, y = 0, width = 0, height = 0;
};

/// What can be seen of a measurement: the same places in each picture, enlarged, and maps of where
/// its error is.
class Details {
 public:
  explicit Details(render::Tone tone) : tone_(tone) {}

  /// The first picture decides which places, and how bright errors are, for all that follow. The
  /// key under which it is kept.
  std::string add(const render::Way& way, int samples, const render::Picture& picture,
                  const render::ReferencePicture& reference);

  /// Puts the pictures of a measurement's points into rows.
  void fill(Report& report) const;

  const PictureDetails& at(const std::string& key) const { return pictures_.at(key); }
  const std::vector<Window>& windows() const noexcept { return windows_; }
  std::vector<std::string> keys() const;

  /// The windows and what goes with them, but no pictures; null before the first.
  Json frame_json() const;
  /// Takes it over for pictures of this size; throws as json_types.hpp says.
  void read_frame(const Json& json, int width, int height);
  /// Takes over what was kept under one of keys().
  void restore(const std::string& key, PictureDetails details) {
    pictures_[key] = std::move(details);
  }

  static std::string key_of(const render::Way& way, int samples);
  static constexpr const char* kReferenceKey = "reference";

 private:
  struct Shown {
    std::string title, key;
  };

  void choose_windows(const render::Picture& picture, const render::ReferencePicture& reference);
  PictureDetails details_of(const render::Picture& picture,
                            const render::ReferencePicture* reference) const;
  std::string png(const render::Picture& picture) const;
  void add_rows(Report& report, const std::string& title, const std::vector<Shown>& shown) const;

  render::Tone tone_;
  std::vector<Window> windows_;
  double top_ = 0;  ///< of the error maps: radiance
  double mean_ = 0;
  int map_width_ = 0, map_height_ = 0;
  int thumbnail_width_ = 0, thumbnail_height_ = 0;
  std::map<std::string, PictureDetails> pictures_;
};

}  // namespace sdlc::cli
