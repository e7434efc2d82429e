#pragma once

#include "render/scene/precision.hpp"
#include "render/scene/scene.hpp"

namespace sdlc::render {

/// PrecisionClause::Radiance of a scene that is seen by paths of up to `depth` rays, where `most`
/// is allowed and its inverse. O(n) time for n materials, on all threads of the calling arena.
PrecisionBound judge_radiance(const Scene& scene, int depth, double most);

}  // namespace sdlc::render
