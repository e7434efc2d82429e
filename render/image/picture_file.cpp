#include "render/image/picture_file.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "render/image/decoded_file.hpp"
#include "render/image/io_error.hpp"

namespace sdlc::render {
namespace {

using Names = std::array<std::string_view, 3>;

constexpr Names kColors{"R", "G", "B"};
constexpr Names kVariances{"variance.R", "variance.G", "variance.B"};

std::array<int, 3> indices_of(const DecodedImage& image, const Names& names) {
  return {channel_index(image, names[0]), channel_index(image, names[1]),
          channel_index(image, names[2])};
}

void check_is_one_picture(const DecodedImage& image, const std::filesystem::path& path) {
  if (image.pictures > 1) {
    throw IoError("read", path,
                  fmt::format("it holds {} pictures; extract the one to use", image.pictures));
  }
}

/// A constant alpha of 1 carries no information.
bool is_opaque(const DecodedImage& image, std::size_t channel) {
  for (std::size_t i = channel; i < image.values.size(); i += image.channels.size()) {
    if (image.values[i] != image.white) return false;
  }
  return true;
}

/// Takes R, G, B and the variance.
void take_exr_channels(const DecodedImage& image, const std::filesystem::path& path,
                       PictureFile& file) {
  const auto colors = indices_of(image, kColors);
  if (std::ranges::count(colors, -1) > 0) {
    throw IoError("read", path,
                  fmt::format("it has no channels R, G and B; its channels are {}",
                              fmt::join(image.channels, ", ")));
  }
  file.picture = picture_of(image, colors);
  const auto variances = indices_of(image, kVariances);
  const auto missing = std::ranges::count(variances, -1);
  if (missing == 0) file.variance = picture_of(image, variances);
  if (missing == 1 || missing == 2) {
    throw IoError("read", path,
                  fmt::format("it has some but not all of {}", fmt::join(kVariances, ", ")));
  }
}

/// Lists the channels that were not used.
void name_others(const DecodedImage& image, PictureFile& file) {
  const auto is_taken = [&](std::size_t channel) {
    const std::string_view name = image.channels[channel];
    if (name == "A" && is_opaque(image, channel)) return true;
    if (file.format != ImageFormat::Exr) return channel < (file.is_grey ? 1u : 3u);
    return std::ranges::find(kColors, name) != kColors.end() ||
           std::ranges::find(kVariances, name) != kVariances.end();
  };
  for (std::size_t i = 0; i < image.channels.size(); ++i) {
    if (!is_taken(i)) file.other_channels.push_back(image.channels[i]);
  }
}

}  // namespace

std::optional<std::string_view> PictureFile::find_metadata(std::string_view key) const noexcept {
  const auto found = std::ranges::find(
      metadata, key, [](const auto& entry) -> std::string_view { return entry.first; });
  if (found == metadata.end()) return std::nullopt;
  return found->second;
}

PictureFile read_picture_file(const std::filesystem::path& path) {
  DecodedFile decoded = decode_file(path);
  DecodedImage& image = decoded.image;
  check_is_one_picture(image, path);
  PictureFile file;
  file.format = decoded.format;
  file.is_linear = describe(decoded.format).is_linear;
  if (file.format == ImageFormat::Exr) {
    const PixelWindow &data = image.data, &display = image.display;
    file.crop = {data.x - display.x, data.y - display.y, data.width, data.height};
    file.whole_width = display.width;
    file.whole_height = display.height;
    take_exr_channels(image, path, file);
  } else {
    file.is_grey = image.channels.size() < 3;
    file.picture = rgb_of(image);
  }
  name_others(image, file);
  if (!file.is_linear) {
    if (!image.has_codes) {
      throw IoError("read", path,
                    fmt::format("its values are not codes of 8 or 16 bits, and {} does not define "
                                "their meaning; write them as .exr",
                                describe(file.format).name));
    }
    file.largest_code = static_cast<int>(image.white);
  }
  file.metadata = std::move(image.metadata);
  return file;
}

}  // namespace sdlc::render
