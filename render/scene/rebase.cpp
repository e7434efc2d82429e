#include "render/scene/rebase.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "render/math/power_of_two.hpp"

namespace sdlc::render {
namespace {

/// Multiplies by 2^e. Two factors, since 2^e alone may be no double.
class PowerOfTwoScale {
 public:
  explicit PowerOfTwoScale(int e) noexcept
      : first_(std::ldexp(1.0, e / 2)), second_(std::ldexp(1.0, e - e / 2)) {}
  double operator()(double v) const noexcept { return v * first_ * second_; }
  Vec3 operator()(Vec3 v) const noexcept { return {(*this)(v.x), (*this)(v.y), (*this)(v.z)}; }

 private:
  double first_, second_;
};

template <typename Function>
void transform_lengths(Scene& scene, const Function& scale, Vec3 origin) {
  for (Sphere& sphere : scene.spheres) {
    sphere.center = scale(sphere.center) - origin;
    sphere.radius = scale(sphere.radius);
  }
  for (Vec3& shift : scene.shifts) shift = scale(shift);
}

}  // namespace

void rebase_to_camera(Scene& scene) {
  const Vec3 view = direction_between(scene.camera.from, scene.camera.at);

  // First to numbers of moderate size, so that the difference to the camera cannot overflow.
  double largest = max_abs(scene.camera.from);
  for (const Sphere& s : scene.spheres) {
    largest = std::max({largest, max_abs(s.center), s.radius});
  }
  for (const Vec3& shift : scene.shifts) largest = std::max(largest, max_abs(shift));
  const PowerOfTwoScale to_moderate(-exponent_of(largest));
  transform_lengths(scene, to_moderate, to_moderate(scene.camera.from));

  double extent = 0;
  for (std::size_t i = 0; i < scene.spheres.size(); ++i) {
    const Sphere& s = scene.spheres[i];
    extent = std::max(extent, length(s.center) + s.radius);
    if (!scene.shifts.empty()) {
      extent = std::max(extent, length(s.center + scene.shifts[i]) + s.radius);
    }
  }
  transform_lengths(scene, PowerOfTwoScale(-exponent_of(extent)), Vec3{});

  scene.camera.from = Vec3{};
  scene.camera.at = view;
}

}  // namespace sdlc::render
