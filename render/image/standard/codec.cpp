#include "render/image/codec.hpp"

#include <exception>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>

#include "render/image/standard/formats.hpp"

namespace sdlc::render {
namespace standard {

void check_size(std::int64_t width, std::int64_t height, std::int64_t max_pixels) {
  if (width <= 0 || height <= 0) throw std::runtime_error("it has no pixels");
  if (width > max_pixels / height) {
    throw std::runtime_error("it has more than " + std::to_string(max_pixels) + " pixels");
  }
}

namespace {

constexpr const char* kOtherFormat = "this module has no such format";
constexpr const char* kNoMemory = "there is not enough memory for its pixels";

class StandardCodec final : public ImageCodec {
 public:
  bool encode(const EncodeRequest& request, std::vector<std::byte>& file,
              std::string& error) noexcept override try {
    switch (request.format) {
      case ImageFormat::Png: file = encode_png(request); return true;
      case ImageFormat::Exr: file = encode_exr(request); return true;
      case ImageFormat::Ppm: file = encode_ppm(request); return true;
      default: throw std::invalid_argument(kOtherFormat);
    }
  } catch (const std::bad_alloc&) {
    error = kNoMemory;
    return false;
  } catch (const std::exception& exception) {
    error = exception.what();
    return false;
  }

  std::unique_ptr<GifEncoder> make_gif_encoder(int, int) noexcept override { return nullptr; }

  Decoding decode(ImageFormat format, std::span<const std::byte> file, std::int64_t max_pixels,
                  DecodedImage& image, std::string& error) noexcept override try {
    switch (format) {
      case ImageFormat::Png: image = decode_png(file, max_pixels); break;
      case ImageFormat::Exr: image = decode_exr(file, max_pixels); break;
      case ImageFormat::Ppm: image = decode_ppm(file, max_pixels); break;
      default: throw std::invalid_argument(kOtherFormat);
    }
    return Decoding::Done;
  } catch (const ForeignFile&) {
    return Decoding::Foreign;
  } catch (const std::bad_alloc&) {
    error = kNoMemory;
    return Decoding::Failed;
  } catch (const std::exception& exception) {
    error = exception.what();
    return Decoding::Failed;
  }
};

}  // namespace
}  // namespace standard
}  // namespace sdlc::render

extern "C" __attribute__((visibility("default"))) sdlc::render::ImageCodecEntry
sdlc_image_codec() noexcept {
  // Never destroyed: other threads may still use it when the process ends.
  // NOLINTNEXTLINE(bugprone-unhandled-exception-at-new): nothing could go on without this memory
  static auto* const codec = new sdlc::render::standard::StandardCodec;
  return {sdlc::render::kImageCodecVersion, codec};
}
