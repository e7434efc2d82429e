#include "render/image/codec_module.hpp"

#include "render/image/io_error.hpp"

namespace sdlc::render {

CodecModule module_of(ImageFormat /*format*/) noexcept { return CodecModule::Standard; }

std::filesystem::path find_codec(CodecModule /*module*/) {
  throw IoError("load", "sdlc_image_codec", "a page encodes and decodes pictures itself");
}

ImageCodec* load_codec(const std::filesystem::path& /*file*/) { return nullptr; }

}  // namespace sdlc::render
