#pragma once

#include "render/film/aov.hpp"
#include "render/scene/scene.hpp"

namespace sdlc::cli {

/// Throws std::bad_alloc for a picture that does not fit into memory, before it is allocated.
/// `has_film`: the samples are kept. `zoom`: each pixel is written as zoom × zoom.
void check_picture_memory(const render::RenderSettings& settings, const render::Aovs& aovs,
                          bool has_film, int zoom = 1);

}  // namespace sdlc::cli
