#pragma once

#include <cstdint>
#include <utility>

#include "render/scene/scene.hpp"
#include "render/session/render.hpp"
#include "tests/support/statistics/estimate.hpp"

/// Short helpers to build test scenes.
namespace sdlc::test {

inline render::Material diffuse(render::LinearRgb color) { return {.color = color}; }
inline render::Material specular(render::LinearRgb color, double fuzz) {
  return {.color = color, .parameter = fuzz, .type = render::MaterialType::Specular};
}
inline render::Material transmissive(render::LinearRgb color, double ior,
                                     render::Fresnel fresnel = render::Fresnel::Schlick) {
  return {.color = color,
          .parameter = ior,
          .type = render::MaterialType::Transmissive,
          .fresnel = fresnel};
}
inline render::Material emissive(render::LinearRgb color, double intensity) {
  return {.color = color, .parameter = intensity, .type = render::MaterialType::Emissive};
}
inline render::Material unlit(render::LinearRgb color) {
  return {.color = color, .type = render::MaterialType::Unlit};
}

/// A scene seen along a narrow beam from `from` towards `at`, under a constant sky.
inline render::Scene beam_scene(render::Vec3 from, render::Vec3 at, render::LinearRgb sky) {
  render::Scene scene;
  const render::Vec3 view = at - from;
  const bool is_vertical = view.x == 0 && view.z == 0;
  scene.camera = {.from = from,
                  .at = at,
                  .up = is_vertical ? render::Vec3{0, 0, 1} : render::Vec3{0, 1, 0},
                  .plane_height = 1,
                  .aspect = 1};
  scene.background = {.bottom = sky, .top = sky};
  return scene;
}

inline void add_sphere(render::Scene& scene, render::Vec3 center, double radius,
                       render::Material material) {
  scene.spheres.push_back({.center = center,
                           .radius = radius,
                           .material = static_cast<std::uint32_t>(scene.materials.size())});
  scene.materials.push_back(material);
}

struct BeamOptions {
  int depth = 16;
  std::uint64_t samples = 1 << 16;
  std::uint64_t seed = 7;
  render::LightSampling light_sampling = render::LightSampling::Off;
};

/// The radiance along the camera's axis, by the portable kernel.
inline Estimate radiance_along_axis(render::Scene scene, const BeamOptions& options) {
  scene.camera.plane_height = 1e-30;  // all pixels look along the axis
  constexpr int kWidth = 256;
  // Standard errors assume independent samples.
  const render::RenderSettings settings{
      .width = kWidth,
      .height = static_cast<int>((options.samples + kWidth - 1) / kWidth),
      .samples = 1,
      .depth = options.depth,
      .seed = options.seed,
      .sampler = render::SamplerKind::Independent,
      .light_sampling = options.light_sampling};
  render::RenderMonitor monitor;
  const render::RenderResult result =
      render::render(std::move(scene), settings, monitor, {.backend = &render::portable_backend()});
  EstimateBuilder builder;
  for (const render::LinearRgb& pixel : result.picture.pixels) builder.add(pixel);
  return builder.estimate();
}

}  // namespace sdlc::test
