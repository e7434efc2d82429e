#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "render/image/image_format.hpp"
#include "render/image/layer.hpp"
#include "render/image/picture.hpp"
#include "render/image/tone.hpp"

namespace sdlc::render {

/// What a picture file says about itself, as far as its format can: all of it in EXR, PNG as text,
/// only `software` in TIFF and JPEG, nothing in the others. No time of day is ever written: the
/// same picture is the same bytes.
struct Metadata {
  std::string software = "sdlc";
  /// Keys carry a prefix: "sdlc:seed".
  std::vector<std::pair<std::string, std::string>> entries = {};
};

struct WriteOptions {
  ImageFormat format = ImageFormat::Png;
  Tone tone = Tone::Srgb;  ///< for formats that are not linear
  bool ppm_text = false;   ///< PPM as decimal numbers (P3), not bytes (P6)
  Metadata metadata = {};
  /// Further channels, in EXR alone: the other formats have no room for them and hold the picture.
  /// Borrowed; their names differ from each other and from R, G and B.
  std::span<const Layer> layers = {};
};

/// Throws the IoError that encode_picture would for a picture of this size.
void check_picture_size(int width, int height, ImageFormat format,
                        const std::filesystem::path& shown);

/// The file, as it would be written to `shown`, which only names the picture in errors.
/// EXR holds the linear values as 32-bit floats, at most the largest one; HDR holds them with one
/// exponent a pixel and without what it cannot express: negative values and NaN become 0, infinity
/// the largest value. The other formats hold to_code8 of each value, JPEG, WebP and GIF then lose a
/// little of it. Throws IoError when the picture is empty or too large for the format, or the codec
/// fails.
std::vector<std::byte> encode_picture(const Picture& picture, const WriteOptions& options,
                                      const std::filesystem::path& shown = "picture");

/// encode_picture, then write_file_atomically; throws IoError.
void write_picture(const std::filesystem::path& path, const Picture& picture,
                   const WriteOptions& options);

/// The picture in a file whose extension names its format. Linear formats give linear radiance, the
/// others code / 255 (their tone curve is not undone: the file does not say which it was). One
/// channel is taken as grey; beside red, green and blue others are dropped. Throws IoError; a file
/// cut short is an error.
Picture read_picture(const std::filesystem::path& path);

/// Starts to load the codec in the background, so that it is ready when the first picture is.
/// Throws IoError at once when it is not installed.
void preload_image_codec();

}  // namespace sdlc::render
