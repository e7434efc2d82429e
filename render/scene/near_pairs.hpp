#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "render/scene/scene.hpp"

namespace sdlc::render {

/// What counts as near, with E the extent of the spheres as seen from the camera: the distance to
/// the far side of the farthest one, over the whole shutter.
struct Nearness {
  double gap_of_extent = 0;     ///< surfaces at most so many E apart, or within each other, touch
  double gap_of_radius = 0;     ///< or so many radii of the larger sphere
  double spread_of_extent = 0;  ///< spheres that overlap, and whose surfaces are at most so many E
                                ///< apart everywhere, nearly coincide
};

/// Two spheres, by their index in the scene.
struct SpherePair {
  std::uint32_t first, second;

  friend bool operator==(const SpherePair&, const SpherePair&) = default;
};

/// Of so few spheres all pairs are looked at.
inline constexpr std::size_t kFewSpheres = 600;

/// Spheres that are near each other for less than such a part of the shutter pass each other.
inline constexpr double kBriefly = 1.0 / 100;

/// All pairs of spheres that touch, from outside or one within the other, or nearly coincide, for
/// more than about a hundredth of the time that the shutter is open; of no more than kFewSpheres
/// all pairs whatever. Spheres of radius 0 and those `left_out` (few) are in none of them, and do
/// not count for E. Each pair once, in an order that depends on the scene alone. Nothing where so
/// many spheres heap up in one place that it would take too long.
///
/// Spheres are sorted along a curve through space, those of one size by themselves, in leaves of
/// sixteen, and each leaf is held against the boxes of the others: O(n log n) time, some 30 bytes a
/// sphere beside the result. Works on all threads of the calling arena.
std::optional<std::vector<SpherePair>> find_near_pairs(
    const Scene& scene, Vec3 camera, const Nearness& nearness,
    std::span<const std::uint32_t> left_out = {});

}  // namespace sdlc::render
