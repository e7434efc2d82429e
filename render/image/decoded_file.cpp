#include "render/image/decoded_file.hpp"

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <iterator>
#include <optional>
#include <span>
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
  // A stream opens a folder without an error and fails only later, without a reason.
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) throw IoError("read", path, "it is a folder");
  // A pipe may block, and a device has no end.
  if (fs::exists(path, ignored) && !fs::is_regular_file(path, ignored)) {
    throw IoError("read", path, "it is not a regular file");
  }
  std::ifstream file(path, std::ios::binary);
  if (!file) throw IoError("read", path, std::generic_category().message(errno));
  const std::string bytes(std::istreambuf_iterator<char>(file), {});
  if (file.bad()) throw IoError("read", path, std::generic_category().message(errno));
  const auto* first = reinterpret_cast<const std::byte*>(bytes.data());
  return {first, first + bytes.size()};
}

/// Detects the format from the first bytes of a file.
std::optional<ImageFormat> format_by_content(std::span<const std::byte> file) {
  using namespace std::string_view_literals;
  struct Beginning {
    std::string_view bytes;
    ImageFormat format;
  };
  static constexpr std::array kBeginnings{
      Beginning{"\x89PNG"sv, ImageFormat::Png}, Beginning{"\x76\x2f\x31\x01"sv, ImageFormat::Exr},
      Beginning{"#?"sv, ImageFormat::Hdr},      Beginning{"II*\0"sv, ImageFormat::Tiff},
      Beginning{"MM\0*"sv, ImageFormat::Tiff},  Beginning{"\xff\xd8\xff"sv, ImageFormat::Jpeg},
      Beginning{"RIFF"sv, ImageFormat::WebP},   Beginning{"GIF8"sv, ImageFormat::Gif}};
  const std::string_view text(reinterpret_cast<const char*>(file.data()), file.size());
  for (const Beginning& beginning : kBeginnings) {
    if (text.starts_with(beginning.bytes)) return beginning.format;
  }
  // P1 to P6: colour, grey, and black and white, each as text and as bytes.
  if (text.size() >= 2 && text[0] == 'P' && text[1] >= '1' && text[1] <= '6') {
    return ImageFormat::Ppm;
  }
  return std::nullopt;
}

void check_content(std::span<const std::byte> file, ImageFormat format, const fs::path& path) {
  if (file.empty()) throw IoError("read", path, "it is empty");
  const std::optional<ImageFormat> content = format_by_content(file);
  if (content == format) return;
  const std::string_view name = describe(format).name;
  if (!content) throw IoError("read", path, fmt::format("its content is not {}", name));
  const ImageFormatInfo& info = describe(*content);
  throw IoError(
      "read", path,
      fmt::format("its content is {}, not {}; call it .{}", info.name, name, info.extensions[0]));
}

}  // namespace

DecodedFile decode_file(const fs::path& path) {
  const std::optional<ImageFormat> format = image_format_of(path);
  if (!format) {
    throw IoError("read", path,
                  fmt::format("its extension is not that of a picture format; known are {}",
                              fmt::join(image_extensions(), ", ")));
  }
  DecodedFile decoded{.format = *format, .image = {}};
  const std::vector<std::byte> file = read_file(path);
  check_content(file, *format, path);
  std::string error;
  const auto decode = [&](CodecModule module) {
    return image_codec(module).decode(*format, file, kMaxPicturePixels, decoded.image, error);
  };
  Decoding decoding = decode(module_of(*format));
  if (decoding == Decoding::Foreign) {
    try {
      decoding = decode(CodecModule::OpenImageIo);
    } catch (const IoError& missing) {
      throw IoError("read", path,
                    fmt::format("only OpenImageIO reads {} files of this kind: {}",
                                describe(*format).name, missing.what()));
    }
  }
  if (decoding != Decoding::Done) throw IoError("read", path, error);
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
    // Divide as doubles: code / 255 is then correctly rounded.
    pixel = LinearRgb(value[channels[0]], value[channels[1]], value[channels[2]]) / image.white;
    value += image.channels.size();
  }
  return picture;
}

Picture rgb_of(const DecodedImage& image) {
  // EXR stores its channels in alphabetical order.
  const std::array named{channel_index(image, "R"), channel_index(image, "G"),
                         channel_index(image, "B")};
  if (std::ranges::find(named, -1) == named.end()) return picture_of(image, named);
  // Grey, with or without alpha: the same value three times.
  if (image.channels.size() < 3) return picture_of(image, {0, 0, 0});
  return picture_of(image, {0, 1, 2});
}

}  // namespace sdlc::render
