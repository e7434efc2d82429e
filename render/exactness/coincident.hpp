#pragma once

#include <cstdint>
#include <vector>

#include "render/scene/scene.hpp"

namespace sdlc::render {

/// A sphere that coincides with an earlier one.
struct CoincidentSphere {
  std::uint32_t sphere;   ///< index of the later one
  std::uint32_t earlier;  ///< index of the first sphere that it coincides with
  bool is_exact;          ///< centre, radius and motion are bit-identical

  friend bool operator==(const CoincidentSphere&, const CoincidentSphere&) = default;
};

/// Returns the spheres whose centre, radius and motion differ from those of an earlier sphere by at
/// most 2^-40 of its radius, in ascending order of `sphere`. Two surfaces in one place are
/// ambiguous (which of the two does a ray leave?), so a scene keeps only the first. Spheres of
/// radius 0 coincide only if equal. O(n) time for spheres that do not coincide, O(n log n) for
/// those that do.
std::vector<CoincidentSphere> find_coincident(const std::vector<Sphere>& spheres,
                                              const std::vector<Vec3>& shifts);

/// Removes the spheres that find_coincident() found, and their shifts.
void remove_coincident(const std::vector<CoincidentSphere>& found, std::vector<Sphere>& spheres,
                       std::vector<Vec3>& shifts);

}  // namespace sdlc::render
