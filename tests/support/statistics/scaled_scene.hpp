#pragma once

#include <cmath>

#include "render/math/power_of_two.hpp"
#include "render/scene/scene.hpp"

namespace sdlc::test {

/// The scene with every length multiplied by 2^exponent, which is exact.
inline render::Scene scaled(render::Scene scene, int exponent) {
  const auto scale = [&](render::Vec3& v) { v = render::scaled_by_power_of_two(v, exponent); };
  scale(scene.camera.from);
  scale(scene.camera.at);
  scene.camera.aperture = std::ldexp(scene.camera.aperture, exponent);
  scene.camera.focus = std::ldexp(scene.camera.focus, exponent);
  for (render::Sphere& sphere : scene.spheres) {
    scale(sphere.center);
    sphere.radius = std::ldexp(sphere.radius, exponent);
  }
  for (render::Vec3& shift : scene.shifts) scale(shift);
  return scene;
}

}  // namespace sdlc::test
