#pragma once

#include <cstdint>
#include <vector>

#include "render/scene/scene.hpp"

namespace sdlc::render {

/// A sphere that coincides with an earlier one.
struct CoincidentSphere {
  std::uint32_t sphere;   ///< index of the later one
  std::uint32_t earlier;  ///< index of the first it coincides with
  bool is_exact;          ///< centre, radius and motion are equal to the bit

  friend bool operator==(const CoincidentSphere&, const CoincidentSphere&) = default;
};

/// The spheres whose centre, radius and motion differ from those of an earlier sphere by at most
/// 2^-40 of its radius, in ascending order of `sphere`. A surface twice in one place has no meaning
/// (which of the two does a ray leave?), so a scene keeps the first alone. Spheres of radius 0
/// coincide only if equal. O(n) time for spheres that do not coincide, O(n log n) for those that
/// do.
std::vector<CoincidentSphere> find_coincident(const std::vector<Sphere>& spheres,
                                              const std::vector<Vec3>& shifts);

/// Takes away the spheres that find_coincident() found, and their shifts.
void remove_coincident(const std::vector<CoincidentSphere>& found, std::vector<Sphere>& spheres,
                       std::vector<Vec3>& shifts);

}  // namespace sdlc::render
