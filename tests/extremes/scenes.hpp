#pragma once

#include <cmath>

#include "tests/support/statistics/scenes.hpp"

namespace sdlc::test {

/// Three large spheres and a field of small ones of all materials on a ground of radius `ground`,
/// under a gradient.
inline render::Scene field_scene(double ground = 1000) {
  using render::LinearRgb;
  render::Scene scene = beam_scene({13, 2, 3}, {0, 0, 0}, LinearRgb{1});
  scene.background = {};
  scene.camera.aspect = 1.5;
  scene.camera.plane_height = 2 * std::tan(10 * M_PI / 180);
  add_sphere(scene, {0, -ground, 0}, ground, diffuse(LinearRgb{0.5}));
  add_sphere(scene, {0, 1, 0}, 1, transmissive(LinearRgb{1}, 1.5));
  add_sphere(scene, {-4, 1, 0}, 1, diffuse({0.4, 0.2, 0.1}));
  add_sphere(scene, {4, 1, 0}, 1, specular({0.7, 0.6, 0.5}, 0));
  int number = 0;
  for (int x = -4; x < 4; ++x) {
    for (int z = -3; z < 3; ++z, ++number) {
      const double a = std::fmod(number * 0.618034, 1.0), b = std::fmod(number * 0.754878, 1.0);
      const render::Vec3 center{1.4 * x + 0.6 * a, 0.2, 1.4 * z + 0.6 * b};
      if (length(center - render::Vec3{4, 0.2, 0}) < 1.3 ||
          length(center - render::Vec3{-4, 0.2, 0}) < 1.3 ||
          length(center - render::Vec3{0, 0.2, 0}) < 1.3) {
        continue;
      }
      switch (number % 4) {
        case 0: add_sphere(scene, center, 0.2, specular({0.9, a, b}, 0.5 * b)); break;
        case 1: add_sphere(scene, center, 0.2, transmissive({1, 1, 1}, 1.3 + b)); break;
        default: add_sphere(scene, center, 0.2, diffuse({a, b, a * b})); break;
      }
    }
  }
  return scene;
}

/// The scene moved by `offset`, with the camera.
inline render::Scene moved(render::Scene scene, render::Vec3 offset) {
  scene.camera.from += offset;
  scene.camera.at += offset;
  for (render::Sphere& sphere : scene.spheres) sphere.center += offset;
  return scene;
}

}  // namespace sdlc::test
