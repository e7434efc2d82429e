#include "render/exactness/camera_surface.hpp"

#include <cmath>

#include "render/exactness/rebase.hpp"
#include "render/parallel/ranges.hpp"
#include "render/scene/bounding_sphere.hpp"
#include "render/scene/instances.hpp"

namespace sdlc::render {
namespace {

/// A quick test without rebasing. False only if the camera is clearly on no sphere's surface: at
/// least a thousandth of the radius away, far more than rounding errors.
bool may_have_camera_on_it(const Sphere& sphere, Vec3 camera) noexcept {
  constexpr double kMin = 1e-290, kMax = 1e300;  // squares that neither underflow nor overflow
  const double squared = sphere.radius * sphere.radius;
  const double apart = length_squared(sphere.center - camera) - squared;
  const bool is_clear = squared > kMin && squared < kMax && std::fabs(apart) > 1e-3 * squared;
  return sphere.radius > 0 && !is_clear;
}

}  // namespace

std::vector<InstancedSphere> find_instanced_under_camera(const Scene& scene) {
  std::vector<InstancedSphere> found;
  if (scene.instances.empty()) return found;
  const Rebase rebase(scene);
  const std::vector<BoundingSphere> all_bounds = bounding_spheres(scene.prototypes);
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
    const Prototype& prototype = scene.prototypes[scene.instances[i].prototype];
    const BoundingSphere& bounds = all_bounds[scene.instances[i].prototype];
    // A moving sphere touches the camera only for an instant.
    if (scene.instances[i].shift != Vec3{}) continue;
    const Sphere around =
        rebase.sphere(placed(scene.instances[i], {bounds.center, bounds.radius, 0}));
    constexpr double kSlack = 1 + 0x1p-30;
    if (length(around.center) > around.radius * kSlack) continue;
    for (std::uint32_t k = 0; k < prototype.spheres.size(); ++k) {
      const Vec3 shift = prototype.shifts.empty() ? Vec3{} : prototype.shifts[k];
      const Sphere there = placed(scene.instances[i], prototype.spheres[k]);
      if (has_camera_on_it(rebase.sphere(there), shift)) found.push_back({i, k});
    }
  }
  return found;
}

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
  // The test is relative, but squares of lengths that are small compared with the scene's extent
  // underflow, so the exact answer needs the unit of the rebased scene.
  const Rebase rebase(scene);
  const auto add = [&](std::size_t& count, std::size_t i) {
    const Vec3 shift = scene.shifts.empty() ? Vec3{} : rebase.shift(scene.shifts[i]);
    count += has_camera_on_it(rebase.sphere(scene.spheres[i]), shift) ? 1 : 0;
  };
  return of_instances + reduce_indices(scene.spheres.size(), std::size_t{0}, add, join);
}

}  // namespace sdlc::render
