#include "render/scene/rebase.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "render/math/power_of_two.hpp"
#include "render/scene/near_pairs.hpp"
#include "render/scene/ranges.hpp"

namespace sdlc::render {
namespace {

double power_of_two(int e) noexcept { return std::ldexp(1.0, e); }

/// max_abs() of what is finite, without a call.
double largest_part(Vec3 v) noexcept {
  return std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)});
}

/// Of moderate size.
int moderate_exponent(const Scene& scene, Vec3 camera) {
  double largest = largest_of(scene.spheres.size(), largest_part(camera), [&](std::size_t i) {
    const Sphere& s = scene.spheres[i];
    return std::max(largest_part(s.center), s.radius);
  });
  largest = largest_of(scene.shifts.size(), largest,
                       [&](std::size_t i) { return largest_part(scene.shifts[i]); });
  return -exponent_of(largest);
}

}  // namespace

CameraFrame::CameraFrame(const Scene& scene, Vec3 camera) {
  const int e = moderate_exponent(scene, camera);
  first_ = power_of_two(e / 2);
  second_ = power_of_two(e - e / 2);
  origin_ = size(camera);
}

double length_of_extreme(Vec3 v) noexcept {
  const int e = exponent_of(max_abs(v));
  return std::ldexp(length(scaled_by_power_of_two(v, -e)), e);
}

Rebase::Rebase(const Scene& scene, std::span<const std::uint32_t> left_out)
    : frame_(scene, scene.camera.from) {
  const bool all_count = left_out.size() == scene.spheres.size();
  const double extent = largest_of(scene.spheres.size(), 0, [&](std::size_t i) {
    if (!all_count && contains(left_out, static_cast<std::uint32_t>(i))) return 0.0;
    const Vec3 center = frame_.place(scene.spheres[i].center);
    const double radius = frame_.size(scene.spheres[i].radius);
    const double opened = moderate_length(center) + radius;
    if (scene.shifts.empty()) return opened;
    return std::max(opened, moderate_length(center + frame_.size(scene.shifts[i])) + radius);
  });
  const int e = -exponent_of(extent);
  first_ = power_of_two(e / 2);
  second_ = power_of_two(e - e / 2);
}

void rebase_to_camera(Scene& scene, std::span<const std::uint32_t> left_out) {
  const Vec3 view = direction_between(scene.camera.from, scene.camera.at);
  const Rebase rebase(scene, left_out);
  for_each_index(scene.spheres.size(),
                 [&](std::size_t i) { scene.spheres[i] = rebase.sphere(scene.spheres[i]); });
  for_each_index(scene.shifts.size(),
                 [&](std::size_t i) { scene.shifts[i] = rebase.shift(scene.shifts[i]); });
  scene.camera.from = Vec3{};
  scene.camera.at = view;
}

}  // namespace sdlc::render
