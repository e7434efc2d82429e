#include <stdexcept>

#include "render/image/codec_module.hpp"
#include "render/image/io_error.hpp"
#include "render/image/standard/formats.hpp"

extern "C" sdlc::render::ImageCodecEntry sdlc_image_codec() noexcept;

namespace sdlc::render {

CodecModule module_of(ImageFormat format) noexcept {
  return format == ImageFormat::Png || format == ImageFormat::Ppm ? CodecModule::Standard
                                                                  : CodecModule::OpenImageIo;
}

std::filesystem::path find_codec(CodecModule module) {
  if (module == CodecModule::Standard) return {};
  throw IoError(
      "load", "sdlc_openimageio.so",
      "this program cannot load modules; it reads and writes PNG without alpha and PPM, "
      "and the programs of the Debian packages sdlc and sdlc-openimageio the other formats");
}

ImageCodec* load_codec(const std::filesystem::path& /*file*/) { return sdlc_image_codec().codec; }

namespace standard {

// Never called: they are not in module_of().
std::vector<std::byte> encode_exr(const EncodeRequest& /*request*/) {
  throw std::logic_error("this program has no OpenEXR");
}

DecodedImage decode_exr(std::span<const std::byte> /*file*/, std::int64_t /*max_pixels*/) {
  throw std::logic_error("this program has no OpenEXR");
}

}  // namespace standard
}  // namespace sdlc::render
