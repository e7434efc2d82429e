#pragma once

#include <cmath>
#include <cstddef>

#include "render/scene/scene.hpp"
#include "render/scene/suspects.hpp"

namespace sdlc::render {

/// Whether the camera of a rebased scene stands on a sphere's surface, as close as spheres that
/// coincide; it then counts as having left it. A sphere that moves touches it for no time at all.
inline bool has_camera_on_it(const Sphere& sphere, Vec3 shift) noexcept {
  return sphere.radius > 0 && shift == Vec3{} &&
         std::fabs(length(sphere.center) - sphere.radius) <= kCoincidenceTolerance * sphere.radius;
}

/// On how many spheres the camera of a scene stands so, once it is rebased. O(n) time, no copy.
std::size_t count_under_camera(const Scene& scene);

}  // namespace sdlc::render
