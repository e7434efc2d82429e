#include "render/image/image_format.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace sdlc::render {
namespace {

constexpr int kUnlimited = std::numeric_limits<int>::max();

constexpr std::array kFormats{
    ImageFormatInfo{ImageFormat::Png, "PNG", {"png"}, false, 1000000},  // the limit of libpng
    ImageFormatInfo{ImageFormat::Exr, "OpenEXR", {"exr"}, true, kUnlimited},
    ImageFormatInfo{ImageFormat::Hdr, "Radiance HDR", {"hdr"}, true, kUnlimited},
    ImageFormatInfo{ImageFormat::Tiff, "TIFF", {"tiff", "tif"}, false, kUnlimited},
    ImageFormatInfo{ImageFormat::Jpeg, "JPEG", {"jpg", "jpeg"}, false, 65500},
    ImageFormatInfo{ImageFormat::WebP, "WebP", {"webp"}, false, 16383},
    ImageFormatInfo{ImageFormat::Ppm, "PPM", {"ppm"}, false, kUnlimited},
    ImageFormatInfo{ImageFormat::Gif, "GIF", {"gif"}, false, 65535},
};

constexpr bool is_indexed_by_format() {
  for (std::size_t i = 0; i < kFormats.size(); ++i) {
    if (kFormats[i].format != static_cast<ImageFormat>(i)) return false;
  }
  return true;
}
static_assert(is_indexed_by_format());

/// ASCII only, so that the format of a file does not depend on the user's locale.
char lower(char c) noexcept { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

}  // namespace

std::span<const ImageFormatInfo> image_formats() noexcept { return kFormats; }

const ImageFormatInfo& describe(ImageFormat format) noexcept {
  return kFormats[static_cast<std::size_t>(format)];
}

std::optional<ImageFormat> image_format_of(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  if (extension.size() < 2) return std::nullopt;
  extension.erase(0, 1);
  std::ranges::transform(extension, extension.begin(), lower);
  for (const ImageFormatInfo& info : kFormats) {
    if (std::ranges::find(info.extensions, extension) != info.extensions.end()) return info.format;
  }
  return std::nullopt;
}

std::string refusal_of_name(const std::filesystem::path& path) {
  constexpr std::size_t kMaxName = 255;  // bytes; the limit of every common file system
  if (path.empty()) return "the name is empty";
  const std::string name = path.filename().string();
  if (name.empty() || name == "." || name == "..") return "it names a folder";
  if (path.string().find('\0') != std::string::npos) return "a name cannot contain U+0000";
  if (name.size() > kMaxName) return fmt::format("the name is longer than {} bytes", kMaxName);
  if (image_format_of(path)) return {};
  const std::string extension = path.extension().string();
  const std::string cause = extension.size() < 2 ? "the name has no extension"
                                                 : fmt::format("unknown extension `{}`", extension);
  return fmt::format("{}; known are {}", cause, fmt::join(image_extensions(), " "));
}

std::string refusal_of_size(int width, int height, ImageFormat format) {
  const ImageFormatInfo& info = describe(format);
  if (std::max(width, height) <= info.max_side) return {};
  return fmt::format("{} × {} pixels are too many for {}, which ends at {} a side", width, height,
                     info.name, info.max_side);
}

std::vector<std::string_view> image_extensions() {
  std::vector<std::string_view> all;
  for (const ImageFormatInfo& info : kFormats) {
    std::ranges::copy_if(info.extensions, std::back_inserter(all),
                         [](std::string_view extension) { return !extension.empty(); });
  }
  return all;
}

}  // namespace sdlc::render
