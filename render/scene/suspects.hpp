#pragma once

#include <cstdint>
#include <vector>

#include "render/scene/scene.hpp"

namespace sdlc::render {

/// How much the radii and each coordinate of the centres of spheres that coincide differ at most,
/// as a part of the radius of either.
inline constexpr double kCoincidenceTolerance = 0x1p-40;

/// Spheres that may coincide with another one, by centre and radius: all that do and few that do
/// not. Indices in ascending order. O(n) time, at most 16 bytes a sphere beside the result.
std::vector<std::uint32_t> find_suspects(const std::vector<Sphere>& spheres);

}  // namespace sdlc::render
