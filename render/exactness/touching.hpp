#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "render/exactness/precision.hpp"
#include "render/scene/scene.hpp"

namespace sdlc::render {

/// Separates touching spheres, whether side by side or nested. Of two spheres whose surfaces are
/// nearer than kMinGap units of rounding times their extent (twice the error of points on them), it
/// shrinks the smaller one until the distance is reached. Otherwise a point on one surface near the
/// contact could be beyond the other one, and its path would be lost. Spheres inside a sphere that
/// shrinks follow it.
///
/// `scene` is rebased. `exact`: the spheres that are computed in double while the others are in
/// float; their points have only their own error. Unchanged are spheres that contain the camera in
/// their surface, that would lose more than 1/64 of their radius, or that pass each other while the
/// shutter is open; and all spheres if too many overlap for the search. `known`:
/// PrecisionBounds::near_pairs in that precision; searched for if missing. O(n log n) time.
void part_touching(Scene& scene, Precision precision, std::span<const std::uint32_t> exact = {},
                   std::optional<std::span<const SpherePair>> known = {});

}  // namespace sdlc::render
