#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/scene/scene.hpp"

namespace sdlc::render {

/// The emissive spheres that surfaces sample directly (next event estimation), as ascending
/// indices. LightSampling::On: all that emit light and can be hit. Spheres of prototypes are never
/// included.
///
/// LightSampling::Auto decides from geometry alone, because a few traced paths would not know about
/// the light that they did not find. Seen from points on diffuse surfaces near the camera, an
/// emitter of radius r and radiance L at distance d covers the share F = (r/d)²/2 of the scattered
/// directions, which adds L²F(1 − F) to the variance of a path. Emitters with F ≤ 1/4 are
/// candidates. All candidates are sampled if together they contribute at least as much variance as
/// everything else: the variance of the other emitters plus the square of the total arriving light,
/// since its gradient, edges and interreflection are of that order. Otherwise connections cost more
/// time than they save.
std::vector<std::uint32_t> choose_lights(const Scene& scene, LightSampling sampling);

/// Whether some material is_rough().
bool has_rough_metal(const Scene& scene) noexcept;

/// Whether some rough metal scatters so widely, compared with the size of a light as seen from
/// there, that it hardly finds the light. Metal of prototypes is ignored.
bool is_metal_rough_for(const Scene& scene, std::span<const std::uint32_t> lights);

/// The spheres by way of which lights are sampled with LightSampling::Caustics, as ascending
/// indices: smooth mirrors, and glass denser than its surroundings. Never those of prototypes and
/// `excluded`, which is sorted.
std::vector<std::uint32_t> choose_casters(const Scene& scene,
                                          std::span<const std::uint32_t> excluded);

}  // namespace sdlc::render
