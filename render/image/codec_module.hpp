#pragma once

#include <filesystem>

#include "render/image/codec.hpp"
#include "render/image/codec_loader.hpp"

/// Where codecs come from: modules beside the program, or, if it has no shared libraries, the
/// program itself (cli/static/linked_codec.cpp defines the same functions).
namespace sdlc::render {

/// The file of a module. Throws IoError if it is missing, or if the system cannot start the threads
/// that loading it needs.
std::filesystem::path find_codec(CodecModule module);

/// Loads the module for the rest of the process: OpenImageIO keeps threads and plugins that do not
/// survive unloading. Throws IoError.
ImageCodec* load_codec(const std::filesystem::path& file);

}  // namespace sdlc::render
