#include "render/tiles/tracer.hpp"

#include <utility>

namespace sdlc::render {

std::unique_ptr<const Tracer> make_tracer(const Kernel& kernel, Scene scene,
                                          const RenderSettings& settings, EmitterTally& emitters) {
  return make_tracer(std::move(scene), settings,
                     {.precision = kernel.precision,
                      .backend = kernel.backend,
                      .search = kernel.search,
                      .exact_spheres = kernel.exact_spheres,
                      .near_pairs = kernel.bounds.near_pairs,
                      .lights = kernel.lights,
                      .emitters = &emitters});
}

}  // namespace sdlc::render
