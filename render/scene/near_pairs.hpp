#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "render/scene/camera_view.hpp"
#include "render/scene/scene.hpp"

namespace sdlc::render {

/// Whether a sphere is one of a few.
inline bool contains(std::span<const std::uint32_t> spheres, std::uint32_t sphere) noexcept {
  return std::find(spheres.begin(), spheres.end(), sphere) != spheres.end();
}

/// Whether one sphere comes before another by size, the largest first; of equal ones the earlier.
inline bool is_larger(const Scene& scene, std::uint32_t a, std::uint32_t b) noexcept {
  const double of_a = scene.spheres[a].radius, of_b = scene.spheres[b].radius;
  return of_a != of_b ? of_a > of_b : a < b;
}

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

/// All pairs of spheres of a view that touch, from outside or one within the other, or nearly
/// coincide, for more than about a hundredth of the time that the shutter is open; of no more than
/// kFewSpheres all pairs whatever. Spheres of radius 0 and those `left_out` (few) are in none of
/// them, and do not count for E. Each pair once, in an order that depends on the scene alone.
/// Nothing where so many spheres heap up in one place that it would take too long.
///
/// Spheres are sorted along a curve through space, those of one size by themselves, in leaves of
/// sixteen, and each leaf is held against the boxes of the others: O(n log n) time, some 30 bytes a
/// sphere beside the result. Works on all threads of the calling arena.
std::optional<std::vector<SpherePair>> find_near_pairs(
    const CameraView& view, const Nearness& nearness, std::span<const std::uint32_t> left_out = {});

/// The same of a scene as seen from a camera.
inline std::optional<std::vector<SpherePair>> find_near_pairs(
    const Scene& scene, Vec3 camera, const Nearness& nearness,
    std::span<const std::uint32_t> left_out = {}) {
  return find_near_pairs(CameraView(scene, camera), nearness, left_out);
}

/// Calls `visit(larger, smaller)` for each of the near `pairs` and for every pair with a sphere
/// that find_near_pairs() has left out.
template <typename Visit>
void for_each_pair(const Scene& scene, std::span<const SpherePair> pairs,
                   std::span<const std::uint32_t> left_out, const Visit& visit) {
  const auto visit_by_size = [&](std::uint32_t a, std::uint32_t b) {
    is_larger(scene, a, b) ? visit(a, b) : visit(b, a);
  };
  for (const auto& [a, b] : pairs) visit_by_size(a, b);
  for (std::uint32_t i = 0; i < scene.spheres.size() && !left_out.empty(); ++i) {
    if (!(scene.spheres[i].radius > 0)) continue;
    for (const std::uint32_t k : left_out) {
      if (!contains(left_out, i) || i < k) visit_by_size(i, k);
    }
  }
}

}  // namespace sdlc::render
