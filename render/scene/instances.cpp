#include "render/scene/instances.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>

namespace sdlc::render {
std::uint64_t count_spheres(const Scene& scene) noexcept {
  std::uint64_t count = scene.spheres.size();
  for (const Instance& instance : scene.instances) {
    const std::uint64_t more = scene.prototypes[instance.prototype].spheres.size();
    count += std::min(more, std::numeric_limits<std::uint64_t>::max() - count);
  }
  return count;
}

bool has_motion(const Scene& scene) noexcept {
  return !scene.shifts.empty() || std::ranges::any_of(scene.prototypes, [](const Prototype& of) {
    return !of.shifts.empty();
  }) || std::ranges::any_of(scene.instances, [](const Instance& of) { return of.shift != Vec3{}; });
}

Sphere placed(const Instance& instance, const Sphere& sphere) noexcept {
  return {.center = instance.placement.apply(sphere.center),
          .radius = sphere.radius * instance.placement.scale,
          .material = sphere.material};
}

Vec3 placed_shift(const Instance& instance, Vec3 shift) noexcept {
  return instance.placement.turn(shift) + instance.shift;
}

Scene without_instances(Scene scene) {
  const bool is_moving = has_motion(scene);
  if (is_moving) scene.shifts.resize(scene.spheres.size());
  for (const Instance& instance : scene.instances) {
    const Prototype& prototype = scene.prototypes[instance.prototype];
    for (std::size_t i = 0; i < prototype.spheres.size(); ++i) {
      scene.spheres.push_back(placed(instance, prototype.spheres[i]));
      if (!is_moving) continue;
      const Vec3 shift = prototype.shifts.empty() ? Vec3{} : prototype.shifts[i];
      scene.shifts.push_back(placed_shift(instance, shift));
    }
  }
  scene.prototypes.clear();
  scene.instances.clear();
  return scene;
}

}  // namespace sdlc::render
