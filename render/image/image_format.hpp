#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sdlc::render {

/// The picture formats that can be written and read.
enum class ImageFormat : std::uint8_t { Png, Exr, Hdr, Tiff, Jpeg, WebP, Ppm, Gif };

/// Properties of a format.
struct ImageFormatInfo {
  ImageFormat format;
  std::string_view name;                       ///< in its official spelling: "OpenEXR"
  std::array<std::string_view, 2> extensions;  ///< lower case, no dot; the second may be empty
  bool is_linear;  ///< holds linear radiance; the others hold 8-bit codes of a tone curve
  int max_side;    ///< the largest width or height the format can hold, in pixels
};

/// One row per format, in the order of the enumerators.
std::span<const ImageFormatInfo> image_formats() noexcept;

const ImageFormatInfo& describe(ImageFormat format) noexcept;

/// The format that the extension of `path` names, ignoring case; nullopt if it names none.
std::optional<ImageFormat> image_format_of(const std::filesystem::path& path);

/// Why no picture can be written under this name, independent of the disk, such as "unknown
/// extension `.bmp`; known are png exr"; empty if one can.
std::string refusal_of_name(const std::filesystem::path& path);

/// The same for a picture of this size in this format.
std::string refusal_of_size(int width, int height, ImageFormat format);

/// Every known extension, in lower case without the dot: for messages and suggestions.
std::vector<std::string_view> image_extensions();

}  // namespace sdlc::render
