#pragma once

#include <cstdint>
#include <vector>

#include "render/scene/scene.hpp"

namespace sdlc::render {

/// The max difference in radius and each coordinate of coincident spheres, relative to the radius
/// of either.
inline constexpr double kCoincidenceTolerance = 0x1p-40;

/// Spheres that may coincide with another one, by centre and radius: all that do, and few that do
/// not. Indices in ascending order. O(n) time, at most 16 bytes per sphere in addition to the
/// result.
std::vector<std::uint32_t> find_suspects(const std::vector<Sphere>& spheres);

}  // namespace sdlc::render
