#pragma once

#include "render/scene/scene.hpp"
#include "tests/support/statistics/scenes.hpp"

/// Scenes with all usual sources of noise.
namespace sdlc::test {

/// Edges, shadows, a lamp and a dim sky.
inline render::Scene small_room() {
  render::Scene scene = beam_scene({0, 1, 5}, {0, 0.3, 0}, render::LinearRgb{0.3});
  scene.camera.aspect = 1.6;
  scene.camera.plane_height = 0.7;
  add_sphere(scene, {0, -100, 0}, 100, diffuse({0.7, 0.6, 0.5}));
  add_sphere(scene, {-1.1, 0.5, 0}, 0.5, diffuse({0.8, 0.2, 0.2}));
  add_sphere(scene, {0, 0.5, 0}, 0.5, diffuse({0.8, 0.8, 0.6}));
  add_sphere(scene, {1.1, 0.5, 0}, 0.5, diffuse({0.2, 0.3, 0.8}));
  add_sphere(scene, {0.5, 4, 1}, 1, emissive({1, 0.9, 0.7}, 2));
  return scene;
}

/// The lamp is also found through brushed metal, but rarely: in such a small picture two or three
/// pixels have most of the error.
inline render::Scene room_with_rare_paths() {
  render::Scene scene = small_room();
  scene.materials[2] = specular({0.9, 0.8, 0.6}, 0.8);
  scene.materials[4] = emissive({1, 0.9, 0.7}, 8);
  scene.spheres[4] = {.center = {0.5, 2.2, 1}, .radius = 0.3, .material = 4};
  return scene;
}

/// Noise in a third of the picture, of several kinds; the rest is the sky.
inline render::Scene things_before_the_sky() {
  render::Scene scene = beam_scene({0, 0, 6}, {0, 0, 0}, render::LinearRgb{1});
  scene.background = {};
  scene.camera.aspect = 1.6;
  scene.camera.plane_height = 0.7;
  add_sphere(scene, {-1.6, 0, 0}, 0.9, diffuse({0.8, 0.3, 0.2}));
  add_sphere(scene, {0.2, -0.3, 0.5}, 0.8, diffuse({0.2, 0.2, 0.3}));
  add_sphere(scene, {1.8, 0.2, 0}, 0.9, specular({0.9, 0.9, 0.9}, 0.5));
  return scene;
}

}  // namespace sdlc::test
