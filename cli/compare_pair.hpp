#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "render/image/picture_file.hpp"
#include "render/image/tone.hpp"

namespace sdlc::cli {

/// Two pictures that can be held against each other: of one size and kind, with finite values.
struct ComparedPair {
  std::string picture_name, reference_name;  ///< as the user named them
  render::PictureFile picture, reference;
  render::Tone tone = render::Tone::Srgb;  ///< of the codes; where values are linear, Linear
  /// Both have a variance, of which all values are finite and not negative.
  bool has_variance = false;
  std::vector<std::string> notes;  ///< what is in the files and is not compared, or was assumed

  /// "linear radiance" or "codes / 255".
  std::string values() const;
};

/// Reads both and refuses what cannot be compared. Throws UsageError and render::IoError.
ComparedPair read_pair(const std::string& picture, const std::string& reference);

}  // namespace sdlc::cli
