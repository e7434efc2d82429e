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
#include "render/math/pixel_window.hpp"

namespace sdlc::render {

/// Metadata of a picture file, as far as the format supports it: all of it in EXR, as text in PNG,
/// only `software` in TIFF and JPEG, none in the others. No time stamp is ever written, so equal
/// pictures give equal bytes.
struct Metadata {
  std::string software = "sdlc";
  /// Keys have a prefix: "sdlc:seed".
  std::vector<std::pair<std::string, std::string>> entries = {};
};

struct WriteOptions {
  ImageFormat format = ImageFormat::Png;
  ToneMapping mapping = {};  ///< for formats that are not linear
  bool ppm_text = false;     ///< PPM as decimal numbers (P3), not bytes (P6)
  Metadata metadata = {};
  /// If this is a part of a picture: the whole one, relative to it, so that x and y are at most 0.
  /// EXR files store both as data window and display window; the other formats ignore it.
  PixelWindow whole = {};
  /// Further channels; only EXR supports them, the other formats ignore them. Borrowed; the names
  /// must be unique and differ from R, G and B.
  std::span<const Layer> layers = {};
};

/// to_codes8 of each pixel, row by row from the top.
std::vector<std::uint8_t> codes_of(const Picture& picture, const ToneMapping& mapping);

/// Throws the IoError that encode_picture would throw for a picture of this size.
void check_picture_size(int width, int height, ImageFormat format,
                        const std::filesystem::path& shown);

/// Returns the contents of the file; `shown` only names the picture in errors. EXR stores the
/// linear values as 32-bit floats, clamped to the largest one. HDR stores them with a shared
/// exponent per pixel: negative values and NaN become 0, infinity the largest value. The other
/// formats store to_codes8 of each pixel; JPEG, WebP and GIF are lossy. Throws IoError if the
/// picture is empty or too large for the format, or if the codec fails.
std::vector<std::byte> encode_picture(const Picture& picture, const WriteOptions& options,
                                      const std::filesystem::path& shown = "picture");

/// encode_picture, then write_file_atomically; throws IoError.
void write_picture(const std::filesystem::path& path, const Picture& picture,
                   const WriteOptions& options);

/// Reads a file whose extension names its format. Linear formats give linear radiance, the others
/// code / 255 (the tone curve is not undone, because the file does not name it). A single channel
/// is read as grey; channels other than red, green and blue are dropped. Throws IoError; a
/// truncated file is an error.
Picture read_picture(const std::filesystem::path& path);

}  // namespace sdlc::render
