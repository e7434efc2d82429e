#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "render/exactness/suspects.hpp"
#include "render/scene/scene.hpp"

namespace sdlc::render {

/// Whether the camera of a rebased scene is on a sphere's surface, within the tolerance for
/// coincident spheres; camera rays then count as leaving that sphere. A moving sphere touches the
/// camera only for an instant, so it never counts.
inline bool has_camera_on_it(const Sphere& sphere, Vec3 shift) noexcept {
  return sphere.radius > 0 && shift == Vec3{} &&
         std::fabs(length(sphere.center) - sphere.radius) <= kCoincidenceTolerance * sphere.radius;
}

/// The number of spheres whose surface contains the camera, as in the rebased scene. O(n) time, no
/// copy.
std::size_t count_under_camera(const Scene& scene);

/// A sphere of an instance, by the index of each.
struct InstancedSphere {
  std::uint32_t instance = 0, sphere = 0;
};
/// The instanced spheres whose surface contains the camera, by the criterion of has_camera_on_it().
/// Visits all spheres of every instance whose bounding sphere contains the camera.
std::vector<InstancedSphere> find_instanced_under_camera(const Scene& scene);

}  // namespace sdlc::render
