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

/// The PNG files that a report shows for one picture.
struct PictureDetails {
  std::vector<std::string> crops;  ///< one per window
  std::string error_map;           ///< for the reference the whole picture, reduced
};

/// A part of a picture, in pixels from its top left.
struct Window {
  std::string title{};
  int x = 0, y = 0, width = 0, height = 0;
};

/// The visual part of a measurement: the same details of each picture, enlarged, and error maps.
class Details {
 public:
  explicit Details(render::Tone tone) : tone_(tone) {}

  /// Adds a picture and returns its key. The first picture determines the windows and the
  /// brightness of error maps.
  std::string add(const render::Configuration& configuration, int samples,
                  const render::Picture& picture, const render::ReferencePicture& reference);

  /// Arranges the pictures of a measurement's points in rows.
  void fill(Report& report) const;

  const PictureDetails& at(const std::string& key) const { return pictures_.at(key); }
  const std::vector<Window>& windows() const noexcept { return windows_; }
  std::vector<std::string> keys() const;

  /// The windows and related data, without pictures; null before the first picture.
  Json frame_json() const;
  /// Restores frame_json() for pictures of this size; throws like the functions of json_types.hpp.
  void read_frame(const Json& json, int width, int height);
  /// Restores a picture that was saved under one of keys().
  void restore(const std::string& key, PictureDetails details) {
    pictures_[key] = std::move(details);
  }

  static std::string key_of(const render::Configuration& configuration, int samples);
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
