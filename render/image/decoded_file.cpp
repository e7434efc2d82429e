#include "render/image/decoded_file.hpp"

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "render/image/codec_loader.hpp"
#include "render/image/io_error.hpp"

namespace sdlc::render {
namespace {

namespace fs = std::filesystem;

std::vector<std::byte> read_file(const fs::path& path) {
  // A stream opens a folder without complaint and fails only later, without saying why.
  if (fs::is_directory(path)) throw IoError("read", path, "it is a folder");
  std::ifstream file(path, std::ios::binary);
  if (!file) throw IoError("read", path, std::generic_category().message(errno));
  const std::string bytes(std::istreambuf_iterator<char>(file), {});
  if (file.bad()) throw IoError("read", path, std::generic_category().message(errno));
  const auto* first = reinterpret_cast<const std::byte*>(bytes.data());
  return {first, first + bytes.size()};
}

}  // namespace

DecodedFile decode_file(const fs::path& path) {
  const std::optional<ImageFormat> format = image_format_of(path);
  if (!format) {
    throw IoError("read", path,
                  fmt::format("its extension names no picture format; known are {}",
                              fmt::join(image_extensions(), ", ")));
  }
  DecodedFile decoded{.format = *format, .image = {}};
  const std::vector<std::byte> file = read_file(path);
  std::string error;
  if (!image_codec().decode(*format, file, kMaxPicturePixels, decoded.image, error)) {
    throw IoError("read", path, error);
  }
  return decoded;
}

int channel_index(const DecodedImage& image, std::string_view name) noexcept {
  const auto found = std::ranges::find(image.channels, name);
  return found == image.channels.end() ? -1 : static_cast<int>(found - image.channels.begin());
}

Picture picture_of(const DecodedImage& image, const std::array<int, 3>& channels) {
  Picture picture(image.width, image.height);
  const float* value = image.values.data();
  for (LinearRgb& pixel : picture.pixels) {
    // Divided as doubles: code / 255 is then the nearest double to it.
    pixel = LinearRgb(value[channels[0]], value[channels[1]], value[channels[2]]) / image.white;
    value += image.channels.size();
  }
  return picture;
}

Picture rgb_of(const DecodedImage& image) {
  // EXR keeps its channels in alphabetical order of any names.
  const std::array named{channel_index(image, "R"), channel_index(image, "G"),
                         channel_index(image, "B")};
  if (std::ranges::find(named, -1) == named.end()) return picture_of(image, named);
  // Grey, with or without an opacity, is the same value three times.
  if (image.channels.size() < 3) return picture_of(image, {0, 0, 0});
  return picture_of(image, {0, 1, 2});
}

}  // namespace sdlc::render
