#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "render/image/image_format.hpp"
#include "render/math/pixel_window.hpp"

namespace sdlc::render {

/// A channel in addition to red, green and blue: one value per pixel, rows from the top.
struct EncodeChannel {
  std::string_view name;
  std::span<const float> values;
};

/// A picture to encode. Rows from the top, three values per pixel, in exactly one of `codes`
/// (formats with 8-bit codes) and `radiance` (linear formats). The spans are borrowed for the call.
struct EncodeRequest {
  ImageFormat format = ImageFormat::Png;
  int width = 0;
  int height = 0;
  PixelWindow display = {};  ///< EXR only: the whole picture, relative to this part
  std::span<const std::uint8_t> codes = {};
  std::span<const float> radiance = {};
  std::span<const EncodeChannel> channels = {};  ///< EXR only, in addition to `radiance`
  bool is_srgb = false;       ///< the codes follow the sRGB curve; the file may record this
  bool ppm_text = false;      ///< PPM as decimal numbers (P3), not bytes (P6)
  std::string software = {};  ///< empty: not written
  std::span<const std::pair<std::string, std::string>> metadata = {};
};

/// The first picture of a file: rows from the top, one value per channel and pixel, in units of
/// `white`.
struct DecodedImage {
  int width = 0;
  int height = 0;
  std::vector<std::string> channels;  ///< names in the order of the values; at least one
  bool has_codes = false;             ///< integers of 8 or 16 bits
  float white = 1;                    ///< the value that represents 1: the largest code
  std::vector<float> values;
  int pictures = 1;           ///< number of parts, pages or frames in the file
  PixelWindow data, display;  ///< EXR only: the stored pixels, and the visible ones
  /// Text entries whose key begins with `sdlc:`.
  std::vector<std::pair<std::string, std::string>> metadata;
};

/// Encodes an animation as a GIF file that repeats without end, frame after frame. The errors are
/// as those of ImageCodec.
class __attribute__((visibility("default"))) GifEncoder {
 public:
  virtual ~GifEncoder() = default;
  /// `codes`: as those of EncodeRequest. `delay`: until the next frame, in 1/100 s.
  virtual bool add(std::span<const std::uint8_t> codes, std::uint16_t delay,
                   std::string& error) noexcept = 0;
  /// Once, after the last frame.
  virtual bool finish(std::vector<std::byte>& file, std::string& error) noexcept = 0;
};

enum class Decoding : std::uint8_t {
  Done,
  Failed,   ///< there is a message
  Foreign,  ///< only another module may know files of this kind
};

/// The interface between the program and a module that encodes and decodes pictures. No exception
/// crosses it: a function that returns false, or fails, has stored a message in `error`.
/// Thread-safe.
class __attribute__((visibility("default"))) ImageCodec {
 public:
  virtual ~ImageCodec() = default;
  virtual bool encode(const EncodeRequest& request, std::vector<std::byte>& file,
                      std::string& error) noexcept = 0;
  /// Null if there is no memory, or no GIF in this module.
  virtual std::unique_ptr<GifEncoder> make_gif_encoder(int width, int height) noexcept = 0;
  /// Rejects files with more than `max_pixels` pixels before allocating any.
  virtual Decoding decode(ImageFormat format, std::span<const std::byte> file,
                          std::int64_t max_pixels, DecodedImage& image,
                          std::string& error) noexcept = 0;
};

/// Must be incremented with every change to this header: the program rejects a module with another
/// number.
inline constexpr int kImageCodecVersion = 6;

/// The result of a module's only exported function, `sdlc_image_codec`. The codec lives as long
/// as the process.
struct ImageCodecEntry {
  int version;
  ImageCodec* codec;
};
using ImageCodecEntryFunction = ImageCodecEntry() noexcept;
inline constexpr const char* kImageCodecSymbol = "sdlc_image_codec";

}  // namespace sdlc::render
