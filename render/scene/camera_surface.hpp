#pragma once

#include <cmath>
#include <cstddef>

#include "render/scene/scene.hpp"
#include "render/scene/suspects.hpp"

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

}  // namespace sdlc::render
