#pragma once

#include <cstdint>

#include "render/image/codec.hpp"
#include "render/image/image_format.hpp"

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

/// Throws IoError if the module that writes a format is not installed, or cannot be loaded for want
/// of threads. Does not load it.
void check_image_codec(ImageFormat format);

/// Loading the codec may take a quarter of a second of one core, which a quick render uses better
/// for tracing; with a time limit the picture must not wait for it.
enum class Preload {
  Late,  ///< after two seconds, or as soon as the codec is needed
  Now,
};

/// Loads the codec of a format in the background, so that it is ready for the first picture. Throws
/// IoError immediately if it is not installed.
void preload_image_codec(ImageFormat format, Preload when = Preload::Late);

}  // namespace sdlc::render
