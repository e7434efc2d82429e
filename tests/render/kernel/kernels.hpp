#pragma once

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "render/scene/settings.hpp"
#include "render/session/render.hpp"
#include "tests/support/statistics/scenes.hpp"

/// The wide kernel in all configurations that this machine can run.
namespace sdlc::test {

struct WideForm {
  const render::Backend* backend;
  render::Precision precision;

  render::KernelRequest request() const {
    return {.search = render::Search::All, .precision = precision, .backend = backend};
  }
};

inline std::vector<WideForm> wide_forms() {
  std::vector<WideForm> forms;
  for (const render::Backend* backend : render::available_vectors()) {
    forms.push_back({backend, render::Precision::Float});
    forms.push_back({backend, render::Precision::Double});
  }
  return forms;
}

/// The backends that this machine can run and that round as the best one does.
inline std::vector<const render::Backend*> equal_backends() {
  std::vector<const render::Backend*> equal;
  for (const render::Backend* backend : render::available_vectors()) {
    if (backend->is_fused == render::best_backend().is_fused) equal.push_back(backend);
  }
  return equal;
}

/// The ground is computed in double when the rest is float.
inline render::Scene balls_above_a_large_ground() {
  render::Scene scene = beam_scene({0, 1, 4}, {0, 0, 0}, render::LinearRgb{0.1});
  scene.camera.plane_height = 1.2;
  add_sphere(scene, {0, -1e4 - 1, 0}, 1e4, diffuse({0.5, 0.6, 0.3}));
  add_sphere(scene, {-1.2, 0, 0}, 0.5, specular({0.8, 0.8, 0.6}, 0.2));
  add_sphere(scene, {0, 0, 0}, 0.5, transmissive({1, 0.9, 1}, 1.5));
  add_sphere(scene, {1.2, 0, 0}, 0.5, diffuse({0.9, 0.2, 0.1}));
  return scene;
}

inline void put_camera_on_a_surface(render::Scene& scene) {
  scene.camera.from = {0, 2, 4};
  add_sphere(scene, {0, 2, 5}, 1, diffuse({0.5, 0.5, 0.5}));
}

/// The largest of the channels.
inline double difference(render::LinearRgb a, render::LinearRgb b) {
  const render::LinearRgb d = a - b;
  return std::max({std::fabs(d.r), std::fabs(d.g), std::fabs(d.b)});
}

inline render::RenderResult render_with(const render::Scene& scene,
                                        const render::RenderSettings& settings,
                                        const render::KernelRequest& request) {
  render::RenderMonitor monitor;
  return render::render(scene, settings, monitor, request);
}

/// Expects that all backends that round alike give the same bytes, in float, mixed and double.
inline void expect_same_bytes(const std::vector<std::pair<const char*, render::Scene>>& scenes,
                              const render::RenderSettings& settings) {
  const auto equal = equal_backends();
  if (equal.size() < 2) GTEST_SKIP() << "this machine has nothing to compare";
  std::set<render::Precision> precisions;
  for (const auto& [name, scene] : scenes) {
    for (const auto precision : {render::Precision::Float, render::Precision::Double}) {
      const auto result = [&](const render::Backend* backend) {
        return render_with(scene, settings, WideForm{backend, precision}.request());
      };
      const render::RenderResult with_first = result(equal.front());
      precisions.insert(with_first.kernel.precision);
      for (const render::Backend* other : equal) {
        EXPECT_EQ(result(other).picture.pixels, with_first.picture.pixels)
            << name << ", " << name_of(precision) << ", " << other->name;
      }
    }
  }
  EXPECT_EQ(precisions.size(), 3u);
}

inline std::string form_name(const testing::TestParamInfo<WideForm>& test) {
  return std::string(test.param.backend->name) + "_" + std::string(name_of(test.param.precision));
}

}  // namespace sdlc::test
