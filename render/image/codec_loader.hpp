#pragma once

#include "render/image/codec.hpp"
#include "render/image/image.hpp"

namespace sdlc::render {

/// Returns the codec; the first call loads it (about 0.2 s). Throws IoError if the module is
/// missing, cannot be loaded or was built for another version of the program.
ImageCodec& image_codec();

/// Loads the codec on another thread. Throws IoError now if there is no module to load;
/// image_codec() reports any other failure.
void preload_codec(Preload when);

}  // namespace sdlc::render
