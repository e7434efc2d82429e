#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "render/scene/precision.hpp"
#include "render/scene/scene.hpp"

namespace sdlc::render {

/// Parts spheres that touch, from outside or one inside the other: shrinks the smaller one of each
/// two whose surfaces come nearer than kLeastGap units of rounding times their extent, twice what
/// points on them are off, until they are as far apart. Around a contact a point on one could else
/// be taken for one beyond the other, and a path that goes on from there would be lost. What lies
/// in a sphere that shrinks follows it.
///
/// `scene` is rebased. `exact`: the spheres that are met in double beside others in float, and on
/// which points are off no more than they are on those. Left as they are: spheres that the camera
/// stands on, that would lose more than 1/64 of their radius, or that pass others while the shutter
/// is open; and all where too many overlap to be looked at. `known`: PrecisionBounds::near_pairs in
/// that precision, without which they are looked for. O(n log n) time.
void part_touching(Scene& scene, Precision precision, std::span<const std::uint32_t> exact = {},
                   std::optional<std::span<const SpherePair>> known = {});

}  // namespace sdlc::render
