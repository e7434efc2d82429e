#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "render/image/picture_file.hpp"
#include "render/image/tone.hpp"

namespace sdlc::cli {

/// Two comparable pictures: of the same size and kind, with finite values.
struct ComparedPair {
  std::string picture_name, reference_name;  ///< as given by the user
  render::PictureFile picture, reference;
  /// That of the codes: tone Linear for linear values.
  render::Tone tone = render::Tone::Srgb;
  /// Both have a variance, whose values are all finite and not negative.
  bool has_variance = false;
  std::vector<std::string> notes;  ///< what the files contain but is not compared, or was assumed

  /// "linear radiance" or "codes / 255".
  std::string values() const;
};

/// Reads both pictures and rejects those that are not comparable. Throws UsageError and
/// render::IoError.
ComparedPair read_pair(const std::string& picture, const std::string& reference);

}  // namespace sdlc::cli
