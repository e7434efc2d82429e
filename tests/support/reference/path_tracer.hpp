#pragma once

#include <span>

#include "render/scene/scene.hpp"
#include "render/session/render.hpp"

namespace sdlc::test {

/// A second implementation of everything that a kernel computes, written to be read: one path at a
/// time, in double, every sphere tested per ray, no tables. It shares random numbers, the prepared
/// scene and the choice of lights with the renderer, so it traces the same paths, and pictures can
/// be compared path by path. Only the points on a lens are drawn in another way, so with a lens
/// pictures agree in expectation.
///
/// Renders without a goal. `scene` has no instances.
render::RenderResult render_by_reference(const render::Scene& scene,
                                         const render::RenderSettings& settings);

}  // namespace sdlc::test
