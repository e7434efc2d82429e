#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "render/image/image_format.hpp"

namespace sdlc::render {

/// A channel beside red, green and blue: one value a pixel, rows from the top.
struct EncodeChannel {
  std::string_view name;
  std::span<const float> values;
};

/// A picture to encode. Rows from the top, three values a pixel, in exactly one of `codes` (formats
/// with 8-bit codes) and `radiance` (linear formats). The spans are borrowed for the call.
struct EncodeRequest {
  ImageFormat format = ImageFormat::Png;
  int width = 0;
  int height = 0;
  std::span<const std::uint8_t> codes = {};
  std::span<const float> radiance = {};
  std::span<const EncodeChannel> channels = {};  ///< of EXR alone, beside `radiance`
  bool is_srgb = false;       ///< the codes follow the sRGB curve, which the file may then say
  bool ppm_text = false;      ///< PPM as decimal numbers (P3), not bytes (P6)
  std::string software = {};  ///< empty: not written
  std::span<const std::pair<std::string, std::string>> metadata = {};
};

/// Where pixels are: from `x`, `y` on, so many of them.
struct PixelWindow {
  int x = 0, y = 0, width = 0, height = 0;

  friend bool operator==(const PixelWindow&, const PixelWindow&) = default;
};

/// The first picture of a file: rows from the top, a value for each channel in each pixel, each a
/// multiple of `white`.
struct DecodedImage {
  int width = 0;
  int height = 0;
  std::vector<std::string> channels;  ///< names in the order of the values, at least one
  bool has_codes = false;             ///< integers of 8 or 16 bits
  float white = 1;                    ///< the value that stands for 1: the largest code
  std::vector<float> values;
  int pictures = 1;           ///< in the file: parts, pages or frames
  PixelWindow data, display;  ///< of EXR: what the file has, and what is meant to be seen
  /// Texts whose key begins with `sdlc:`.
  std::vector<std::pair<std::string, std::string>> metadata;
};

/// The border between the program and the module that encodes and decodes pictures. Nothing is
/// thrown across it: a function that returns false has put a sentence into `error`. May be called
/// from several threads.
class __attribute__((visibility("default"))) ImageCodec {
 public:
  virtual ~ImageCodec() = default;
  virtual bool encode(const EncodeRequest& request, std::vector<std::byte>& file,
                      std::string& error) noexcept = 0;
  /// Refuses files of more than `max_pixels` pixels before it allocates any.
  virtual bool decode(ImageFormat format, std::span<const std::byte> file, std::int64_t max_pixels,
                      DecodedImage& image, std::string& error) noexcept = 0;
};

/// To be raised with any change to this header: the program refuses a module with another number.
inline constexpr int kImageCodecVersion = 3;

/// The module's only visible function, `sdlc_image_codec`, returns this. The codec lives as long as
/// the process.
struct ImageCodecEntry {
  int version;
  ImageCodec* codec;
};
using ImageCodecEntryFunction = ImageCodecEntry() noexcept;
inline constexpr const char* kImageCodecSymbol = "sdlc_image_codec";

}  // namespace sdlc::render
