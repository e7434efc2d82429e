#include "render/exactness/rebase.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "render/exactness/instance_extremes.hpp"
#include "render/exactness/near_pairs.hpp"
#include "render/math/power_of_two.hpp"
#include "render/parallel/ranges.hpp"
#include "render/scene/bounding_sphere.hpp"
#include "render/scene/instances.hpp"

namespace sdlc::render {
namespace {

double power_of_two(int e) noexcept { return std::ldexp(1.0, e); }

/// max_abs() of finite components, without a function call.
double largest_part(Vec3 v) noexcept {
  return std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)});
}

/// The exponent that scales the scene to moderate size.
int moderate_exponent(const Scene& scene, Vec3 camera) {
  double largest = largest_of(scene.spheres.size(), largest_part(camera), [&](std::size_t i) {
    const Sphere& s = scene.spheres[i];
    return std::max(largest_part(s.center), s.radius);
  });
  largest = largest_of(scene.shifts.size(), largest,
                       [&](std::size_t i) { return largest_part(scene.shifts[i]); });
  const std::vector<BoundingSphere> all_bounds = bounding_spheres(scene.prototypes);
  largest = largest_of(scene.instances.size(), largest, [&](std::size_t i) {
    const auto& [prototype, placement, shift] = scene.instances[i];
    const BoundingSphere& bounds = all_bounds[prototype];
    return std::max({largest_part(placement.apply(bounds.center)), largest_part(shift),
                     bounds.radius * placement.scale});
  });
  return -exponent_of(largest);
}

}  // namespace

CameraFrame::CameraFrame(const Scene& scene, Vec3 camera) {
  const int e = moderate_exponent(scene, camera);
  first_ = power_of_two(e / 2);
  second_ = power_of_two(e - e / 2);
  origin_ = size(camera);
}

Rebase::Rebase(const Scene& scene, std::span<const std::uint32_t> left_out)
    : frame_(scene, scene.camera.from) {
  const bool all_count = left_out.size() == scene.spheres.size() && scene.instances.empty();
  double extent = largest_of(scene.spheres.size(), 0, [&](std::size_t i) {
    if (!all_count && contains(left_out, static_cast<std::uint32_t>(i))) return 0.0;
    const Vec3 center = frame_.place(scene.spheres[i].center);
    const double radius = frame_.size(scene.spheres[i].radius);
    const double opened = moderate_length(center) + radius;
    if (scene.shifts.empty()) return opened;
    return std::max(opened, moderate_length(center + frame_.size(scene.shifts[i])) + radius);
  });
  extent =
      std::max(extent, extent_of_instances(scene, frame_)) + frame_.size(scene.camera.aperture) / 2;
  const int e = -exponent_of(extent);
  first_ = power_of_two(e / 2);
  second_ = power_of_two(e - e / 2);
}

Instance Rebase::instance(const Instance& from, const BoundingSphere& bounds) const noexcept {
  const Placement& placement = from.placement;
  const int e = exponent_of(bounds.radius);
  const auto turned = [&](Vec3 column) { return scaled_by_power_of_two(shift(column), e); };
  return {.prototype = from.prototype,
          .placement = {.x = turned(placement.x),
                        .y = turned(placement.y),
                        .z = turned(placement.z),
                        .translate = scaled(frame_.place(placement.apply(bounds.center))),
                        .scale = std::ldexp(size(placement.scale), e)},
          .shift = shift(from.shift)};
}

void center_prototype(Prototype& prototype, const BoundingSphere& bounds) noexcept {
  const int e = -exponent_of(bounds.radius);
  for (Sphere& sphere : prototype.spheres) {
    sphere.center = scaled_by_power_of_two(sphere.center - bounds.center, e);
    sphere.radius = std::ldexp(sphere.radius, e);
  }
  for (Vec3& shift : prototype.shifts) shift = scaled_by_power_of_two(shift, e);
}

void rebase_to_camera(Scene& scene, std::span<const std::uint32_t> left_out) {
  const Vec3 view = direction_between(scene.camera.from, scene.camera.at);
  const Rebase rebase(scene, left_out);
  for_each_index(scene.spheres.size(),
                 [&](std::size_t i) { scene.spheres[i] = rebase.sphere(scene.spheres[i]); });
  for_each_index(scene.shifts.size(),
                 [&](std::size_t i) { scene.shifts[i] = rebase.shift(scene.shifts[i]); });
  const std::vector<BoundingSphere> all_bounds = bounding_spheres(scene.prototypes);
  for_each_index(scene.instances.size(), [&](std::size_t i) {
    scene.instances[i] =
        rebase.instance(scene.instances[i], all_bounds[scene.instances[i].prototype]);
  });
  for (std::size_t i = 0; i < all_bounds.size(); ++i)
    center_prototype(scene.prototypes[i], all_bounds[i]);
  scene.camera.aperture = rebase.length(scene.camera.aperture);
  scene.camera.focus = rebase.length(scene.camera.focus);
  scene.camera.from = Vec3{};
  scene.camera.at = view;
}

}  // namespace sdlc::render
