#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "render/image/image_format.hpp"
#include "render/image/picture.hpp"
#include "render/math/pixel_window.hpp"

namespace sdlc::render {

/// The contents of a picture file, including what `picture` does not hold.
struct PictureFile {
  ImageFormat format = ImageFormat::Png;
  bool is_linear = false;  ///< linear radiance; otherwise the values are code / largest code
  int largest_code = 0;    ///< 255 or 65535; 0 if the values are linear
  bool is_grey = false;    ///< one value for all three colours, which `picture` repeats three times
  Picture picture;
  PixelWindow crop;  ///< EXR only: the place of the picture in the whole one
  int whole_width = 0, whole_height = 0;
  /// Per value of the picture, as `render --aov variance` writes it. Not validated.
  std::optional<Picture> variance;
  /// Names: "A" if not opaque everywhere, "normal.X".
  std::vector<std::string> other_channels;
  /// Metadata written by sdlc, if the format supports it: "sdlc:seed" and its value.
  std::vector<std::pair<std::string, std::string>> metadata;

  /// nullopt if the key does not exist.
  std::optional<std::string_view> find_metadata(std::string_view key) const noexcept;
};

/// Reads a picture strictly: throws IoError for everything that read_picture rejects, and also for
/// a file with several pictures, an EXR file without R, G and B or with an incomplete set of
/// variance channels, and for codes other than integers of 8 or 16 bits.
PictureFile read_picture_file(const std::filesystem::path& path);

}  // namespace sdlc::render
