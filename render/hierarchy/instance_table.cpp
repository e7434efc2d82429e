#include "render/hierarchy/instance_table.hpp"

#include <algorithm>

#include "render/scene/bounding_sphere.hpp"
#include "render/scene/instances.hpp"

namespace sdlc::render {

std::size_t InstanceTable::memory_bytes() const noexcept {
  std::size_t bytes =
      rows.capacity() * sizeof(double) + row_of_bounds.capacity() * sizeof(std::uint32_t);
  for (const auto& table : shift) bytes += table.capacity() * sizeof(double);
  return bytes;
}

void InstanceTable::add_row(const Placement& placement, std::uint32_t root_of_prototype) {
  const double scale = placement.scale;
  for (const Vec3 axis : {placement.x, placement.y, placement.z}) {
    rows.insert(rows.end(), {axis.x / scale, axis.y / scale, axis.z / scale});
  }
  const Vec3 to = placement.translate;
  rows.insert(rows.end(),
              {to.x, to.y, to.z, scale, 1 / scale, static_cast<double>(root_of_prototype), 0.0});
}

Prototype instance_bounds(const Scene& scene) {
  const std::vector<BoundingSphere> all_bounds = bounding_spheres(scene.prototypes);
  const bool is_moving = std::ranges::any_of(
      scene.instances, [](const Instance& instance) { return instance.shift != Vec3{}; });
  // The error of a point on a ray is a few units of rounding times its distance, which is at most
  // 2.
  constexpr double kRelativeSlack = 0x1p-40, kSlack = 0x1p-48;
  Prototype all;
  all.spheres.reserve(scene.instances.size());
  for (const Instance& instance : scene.instances) {
    const BoundingSphere& bounds = all_bounds[instance.prototype];
    Sphere around = placed(instance, {.center = bounds.center, .radius = bounds.radius});
    around.radius += around.radius * kRelativeSlack + kSlack;
    all.spheres.push_back(around);
    if (is_moving) all.shifts.push_back(instance.shift);
  }
  return all;
}

}  // namespace sdlc::render
