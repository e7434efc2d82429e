#pragma once

#include "render/image/codec.hpp"

namespace sdlc::render {

/// What the libraries behind the codec start while they are loaded, which cannot be helped, and
/// some to spare: four of log4cplus, one of OpenImageIO. They end the process, or wait for ever,
/// where one cannot be started.
inline constexpr int kCodecThreads = 6;

/// The codec, loaded by the first call in the process (about 0.2 s). Throws IoError when the module
/// is missing, cannot be loaded or was built for another version of the program.
ImageCodec& image_codec();

/// Loads the codec on another thread, from two seconds on or when it is wanted. Throws IoError
/// now if there is no module to load; any other failure is image_codec's to report.
void preload_codec();

}  // namespace sdlc::render
