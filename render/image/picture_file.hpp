#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "render/image/image_format.hpp"
#include "render/image/picture.hpp"

namespace sdlc::render {

/// What a picture file holds, and what of it is not in `picture`.
struct PictureFile {
  ImageFormat format = ImageFormat::Png;
  bool is_linear = false;  ///< linear radiance; otherwise the values are code / largest code
  int largest_code = 0;    ///< 255 or 65535; 0 where the values are linear
  bool is_grey = false;    ///< one value for all three colours, which the picture has three times
  Picture picture;
  /// Of each value of the picture, as `render --aov variance` writes it; may be anything as long
  /// as nobody has looked.
  std::optional<Picture> variance;
  /// By name: "A" if it is not opaque everywhere, "normal.X".
  std::vector<std::string> other_channels;
  /// What sdlc says of the picture, where the format has room: "sdlc:seed" and its value.
  std::vector<std::pair<std::string, std::string>> metadata;

  /// Nothing if there is none of this key.
  std::optional<std::string_view> find_metadata(std::string_view key) const noexcept;
};

/// Reads a file of which nothing may be left to a guess. Throws IoError for all that read_picture
/// does, and for a file of several pictures, an EXR file without R, G and B, with some but not all
/// channels of a variance, or whose pixels are not all of the picture, and for codes that are no
/// integers of 8 or 16 bits.
PictureFile read_picture_file(const std::filesystem::path& path);

}  // namespace sdlc::render
