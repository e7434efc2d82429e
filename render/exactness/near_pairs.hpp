#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "render/exactness/camera_view.hpp"
#include "render/scene/scene.hpp"

namespace sdlc::render {

/// Linear search; meant for a few spheres.
inline bool contains(std::span<const std::uint32_t> spheres, std::uint32_t sphere) noexcept {
  return std::find(spheres.begin(), spheres.end(), sphere) != spheres.end();
}

/// Orders spheres by size, the largest first; ties by index.
inline bool is_larger(const Scene& scene, std::uint32_t a, std::uint32_t b) noexcept {
  const double of_a = scene.spheres[a].radius, of_b = scene.spheres[b].radius;
  return of_a != of_b ? of_a > of_b : a < b;
}

/// The criteria for near spheres. E is the extent of the spheres as seen from the camera: the
/// distance to the far side of the farthest one, over the whole shutter.
struct Nearness {
  double gap_of_extent = 0;     ///< surfaces within this distance touch, in units of E
  double gap_of_radius = 0;     ///< the same in units of the larger radius
  double spread_of_extent = 0;  ///< overlapping spheres nearly coincide if their surfaces are
                                ///< nowhere further apart than this, in units of E
};

/// Two spheres, by their index in the scene.
struct SpherePair {
  std::uint32_t first, second;

  friend bool operator==(const SpherePair&, const SpherePair&) = default;
};

/// Up to this number of spheres all pairs are checked.
inline constexpr std::size_t kFewSpheres = 600;

/// Spheres that are near each other for a smaller part of the shutter interval pass each other.
inline constexpr double kBriefly = 1.0 / 100;

/// Returns all pairs of spheres that touch, from outside or one within the other, or nearly
/// coincide, for more than about a hundredth of the shutter interval. With at most kFewSpheres
/// spheres it returns all pairs. Spheres of radius 0 and the few `left_out` are excluded, also from
/// E. Each pair occurs once; the order depends on the scene only. Returns nullopt if so many
/// spheres cluster in one place that it would take too long.
///
/// Sorts the spheres along a space-filling curve, separately by size, into leaves of sixteen, and
/// tests each leaf against the boxes of the others: O(n log n) time, about 30 bytes per sphere in
/// addition to the result. Uses all threads of the caller.
std::optional<std::vector<SpherePair>> find_near_pairs(
    const CameraView& view, const Nearness& nearness, std::span<const std::uint32_t> left_out = {});

/// The same for a scene as seen from a camera.
inline std::optional<std::vector<SpherePair>> find_near_pairs(
    const Scene& scene, Vec3 camera, const Nearness& nearness,
    std::span<const std::uint32_t> left_out = {}) {
  return find_near_pairs(CameraView(scene, camera), nearness, left_out);
}

/// Calls `visit(larger, smaller)` for each pair of `pairs` and for every pair with one of the
/// spheres `left_out`.
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
