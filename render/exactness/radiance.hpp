#pragma once

#include "render/exactness/precision.hpp"
#include "render/scene/scene.hpp"

namespace sdlc::render {

/// PrecisionClause::Radiance for paths of up to `depth` rays: values have to be in [1 / max, max].
/// O(n) time for n materials, on all threads of the caller.
PrecisionBound judge_radiance(const Scene& scene, int depth, double max);

}  // namespace sdlc::render
