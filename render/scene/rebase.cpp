#include "render/scene/rebase.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "render/math/power_of_two.hpp"
#include "render/scene/near_pairs.hpp"

namespace sdlc::render {
namespace {

double power_of_two(int e) noexcept { return std::ldexp(1.0, e); }

/// Of moderate size.
int moderate_exponent(const Scene& scene, Vec3 camera) noexcept {
  double largest = max_abs(camera);
  for (const Sphere& s : scene.spheres) {
    largest = std::max({largest, max_abs(s.center), s.radius});
  }
  for (const Vec3& shift : scene.shifts) largest = std::max(largest, max_abs(shift));
  return -exponent_of(largest);
}

}  // namespace

CameraFrame::CameraFrame(const Scene& scene, Vec3 camera) noexcept {
  const int e = moderate_exponent(scene, camera);
  first_ = power_of_two(e / 2);
  second_ = power_of_two(e - e / 2);
  origin_ = size(camera);
}

double moderate_length(Vec3 v) noexcept {
  const int e = exponent_of(max_abs(v));
  constexpr int kSafe = 400;  // squares of such numbers are far from the ends of double
  if (e > -kSafe && e < kSafe) return length(v);
  return std::ldexp(length(scaled_by_power_of_two(v, -e)), e);
}

Rebase::Rebase(const Scene& scene, std::span<const std::uint32_t> left_out) noexcept
    : frame_(scene, scene.camera.from) {
  const bool all_count = left_out.size() == scene.spheres.size();
  double extent = 0;
  for (std::uint32_t i = 0; i < scene.spheres.size(); ++i) {
    if (!all_count && contains(left_out, i)) continue;
    const Vec3 center = frame_.place(scene.spheres[i].center);
    const double radius = frame_.size(scene.spheres[i].radius);
    extent = std::max(extent, moderate_length(center) + radius);
    if (!scene.shifts.empty()) {
      const Vec3 shift = frame_.size(scene.shifts[i]);
      extent = std::max(extent, moderate_length(center + shift) + radius);
    }
  }
  const int e = -exponent_of(extent);
  first_ = power_of_two(e / 2);
  second_ = power_of_two(e - e / 2);
}

void rebase_to_camera(Scene& scene, std::span<const std::uint32_t> left_out) {
  const Vec3 view = direction_between(scene.camera.from, scene.camera.at);
  const Rebase rebase(scene, left_out);
  for (Sphere& sphere : scene.spheres) sphere = rebase.sphere(sphere);
  for (Vec3& shift : scene.shifts) shift = rebase.shift(shift);
  scene.camera.from = Vec3{};
  scene.camera.at = view;
}

}  // namespace sdlc::render
