#include "render/scene/camera_surface.hpp"

#include <cmath>

#include "render/scene/instances.hpp"
#include "render/scene/ranges.hpp"
#include "render/scene/rebase.hpp"

namespace sdlc::render {
namespace {

/// False only where the camera of a scene that is not rebased stands on no sphere's surface: what
/// is off by a thousandth, far more than rounding makes of it.
bool may_have_camera_on_it(const Sphere& sphere, Vec3 camera) noexcept {
  constexpr double kLeast = 1e-290, kMost = 1e300;  // of squares that neither vanish nor overflow
  const double squared = sphere.radius * sphere.radius;
  const double apart = length_squared(sphere.center - camera) - squared;
  const bool is_clear = squared > kLeast && squared < kMost && std::fabs(apart) > 1e-3 * squared;
  return sphere.radius > 0 && !is_clear;
}

}  // namespace

std::size_t count_under_camera(const Scene& scene) {
  const std::size_t of_instances = find_instanced_under_camera(scene).size();
  const Vec3 camera = scene.camera.from;
  const auto add_possible = [&](std::size_t& count, std::size_t i) {
    count += may_have_camera_on_it(scene.spheres[i], camera) ? 1 : 0;
  };
  const auto join = [](std::size_t& count, std::size_t other) { count += other; };
  if (reduce_indices(scene.spheres.size(), std::size_t{0}, add_possible, join) == 0) {
    return of_instances;
  }
  // The claim is relative, but squares of what is small beside the scene's extent vanish: only in
  // the very unit of the rebased scene is the answer the same as there.
  const Rebase rebase(scene);
  const auto add = [&](std::size_t& count, std::size_t i) {
    const Vec3 shift = scene.shifts.empty() ? Vec3{} : rebase.shift(scene.shifts[i]);
    count += has_camera_on_it(rebase.sphere(scene.spheres[i]), shift) ? 1 : 0;
  };
  return of_instances + reduce_indices(scene.spheres.size(), std::size_t{0}, add, join);
}

}  // namespace sdlc::render
