#pragma once

#include <cstdint>

#include "render/image/codec.hpp"
#include "render/image/image.hpp"

namespace sdlc::render {

/// The modules that encode and decode pictures.
enum class CodecModule : std::uint8_t {
  Standard,     ///< PNG, OpenEXR and PPM; loaded in milliseconds
  OpenImageIo,  ///< the other formats, and files of other programs; loaded in 0.2 s
};

/// The module that writes a format. It reads at least what it writes.
CodecModule module_of(ImageFormat format) noexcept;

/// Returns the codec of a module; the first call loads it. Throws IoError if the module is missing,
/// cannot be loaded or was built for another version of the program.
ImageCodec& image_codec(CodecModule module);
inline ImageCodec& image_codec(ImageFormat format) { return image_codec(module_of(format)); }

}  // namespace sdlc::render
