#include "render/image/image.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "render/image/atomic_file.hpp"
#include "render/image/codec_loader.hpp"
#include "render/image/decoded_file.hpp"
#include "render/image/io_error.hpp"

namespace sdlc::render {
namespace {

namespace fs = std::filesystem;

/// Near the largest value that the shared exponent of the HDR format can express, 2^127.
constexpr double kMaxHdrValue = 1e38;

/// `convert` applied to every component, in file order.
template <typename Value, typename Convert>
std::vector<Value> components(const Picture& picture, Convert convert) {
  std::vector<Value> values;
  values.reserve(picture.pixels.size() * 3);
  for (const LinearRgb& pixel : picture.pixels) {
    for (const double v : {pixel.r, pixel.g, pixel.b}) values.push_back(convert(v));
  }
  return values;
}

float to_hdr(double v) noexcept {
  if (!(v > 0)) return 0;  // NaN takes this branch
  return static_cast<float>(std::min(v, kMaxHdrValue));
}

std::vector<EncodeChannel> channels_of(std::span<const Layer> layers, const Picture& picture,
                                       const fs::path& shown) {
  std::vector<EncodeChannel> channels;
  for (const Layer& layer : layers) {
    if (layer.values.size() != picture.pixels.size()) {
      throw IoError(
          "write", shown,
          fmt::format("`{}` has a different number of pixels than the picture", layer.name));
    }
    channels.push_back({.name = layer.name, .values = layer.values});
  }
  return channels;
}

}  // namespace

std::vector<std::uint8_t> codes_of(const Picture& picture, const ToneMapping& mapping) {
  std::vector<std::uint8_t> codes;
  codes.reserve(picture.pixels.size() * 3);
  for (const LinearRgb& pixel : picture.pixels) {
    const auto rgb = to_codes8(mapping, pixel);
    codes.insert(codes.end(), rgb.begin(), rgb.end());
  }
  return codes;
}

void check_picture_size(int width, int height, ImageFormat format, const fs::path& shown) {
  const auto fail = [&](const std::string& cause) { throw IoError("write", shown, cause); };
  if (width <= 0 || height <= 0) fail("the picture is empty");
  if (const std::string refusal = refusal_of_size(width, height, format); !refusal.empty()) {
    fail(refusal);
  }
  if (std::int64_t{width} * height > kMaxPicturePixels) {
    fail(fmt::format("more than {} pixels", kMaxPicturePixels));
  }
}

std::vector<std::byte> encode_picture(const Picture& picture, const WriteOptions& options,
                                      const fs::path& shown) {
  check_picture_size(picture.width, picture.height, options.format, shown);
  if (picture.pixels.size() !=
      static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height)) {
    throw IoError("write", shown, "the number of pixels does not match the size");
  }
  const Tone tone = options.mapping.tone;
  EncodeRequest request{.format = options.format,
                        .width = picture.width,
                        .height = picture.height,
                        .display = options.whole,
                        .is_srgb = tone == Tone::Srgb || tone == Tone::Neutral,
                        .ppm_text = options.ppm_text,
                        .software = options.metadata.software,
                        .metadata = options.metadata.entries};
  std::vector<std::uint8_t> codes;
  std::vector<float> radiance;
  if (options.format == ImageFormat::Hdr) {
    radiance = components<float>(picture, to_hdr);
  } else if (describe(options.format).is_linear) {
    radiance = components<float>(picture, to_float);
  } else {
    codes = codes_of(picture, options.mapping);
  }
  request.codes = codes;
  request.radiance = radiance;
  std::vector<EncodeChannel> channels;
  if (options.format == ImageFormat::Exr) channels = channels_of(options.layers, picture, shown);
  request.channels = channels;

  std::vector<std::byte> file;
  std::string error;
  if (!image_codec(options.format).encode(request, file, error))
    throw IoError("write", shown, error);
  return file;
}

void write_picture(const fs::path& path, const Picture& picture, const WriteOptions& options) {
  write_file_atomically(path, encode_picture(picture, options, path));
}

Picture read_picture(const fs::path& path) { return rgb_of(decode_file(path).image); }

}  // namespace sdlc::render
