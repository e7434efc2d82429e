#pragma once

#include <memory>

#include "render/light/emitter_tally.hpp"
#include "render/scene/scene.hpp"
#include "render/tiles/kernel.hpp"
#include "render/wide/tracer.hpp"

namespace sdlc::render {

/// `kernel`: from choose_kernel() for this scene, not refused. `emitters` counts the emitters that
/// paths reach; the tracer keeps a reference.
std::unique_ptr<const Tracer> make_tracer(const Kernel& kernel, Scene scene,
                                          const RenderSettings& settings, EmitterTally& emitters);

}  // namespace sdlc::render
