#include <algorithm>
#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <benchmark/benchmark.h>

#include "bench/benchmarks.hpp"
#include "bench/renders.hpp"

// The cost of a feature: nine matt spheres under a constant sky, with and without the feature,
// rendered interleaved; the counters are medians. A feature changes which rays exist, so their
// number is reported too: a path that ends at a lamp is shorter, and cheaper for it.
namespace sdlc::bench {
namespace {

using render::LinearRgb;
using render::Material;
using render::MaterialType;
using render::Scene;

/// Every third sphere above the ground is made of `material`.
Scene with_material(const Material& material) {
  Scene scene = eight_on_ground();
  for (std::size_t i = 1; i < scene.materials.size(); i += 3) scene.materials[i] = material;
  return scene;
}

Scene with_motion() {
  Scene scene = eight_on_ground();
  scene.shifts.resize(scene.spheres.size());
  for (std::size_t i = 1; i < scene.shifts.size(); i += 3) scene.shifts[i] = {0, 0.3, 0};
  return scene;
}

Scene with_lens() {
  Scene scene = eight_on_ground();
  scene.camera.aperture = 0.1;
  scene.camera.focus = length(scene.camera.at - scene.camera.from);
  return scene;
}

Scene with_gradient() {
  Scene scene = eight_on_ground();
  scene.background = {};
  return scene;
}

Scene with_everything() {
  Scene scene = with_motion();
  scene.background = {};
  scene.materials[1] = {
      .color = LinearRgb{1}, .parameter = 1.5, .type = MaterialType::Transmissive};
  scene.materials[4] = {.color = LinearRgb{0.8}, .parameter = 0.2, .type = MaterialType::Specular};
  scene.materials[7] = {.color = LinearRgb{1}, .parameter = 2, .type = MaterialType::Emissive};
  return scene;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

void register_feature(const std::string& name, Scene with, const Form& form) {
  const auto scenes = std::make_shared<const std::pair<Scene, Scene>>(eight_on_ground(), with);
  benchmark::RegisterBenchmark(("feature/" + name + "/" + form.name).c_str(),
                               [scenes, form](benchmark::State& state) {
                                 std::vector<double> plain_times, times, ratios;
                                 Timing plain, timing;
                                 for (auto _ : state) {
                                   plain = time_render(scenes->first, form, 16);
                                   timing = time_render(scenes->second, form, 16);
                                   plain_times.push_back(plain.nanoseconds_per_ray());
                                   times.push_back(timing.nanoseconds_per_ray());
                                   ratios.push_back(times.back() / plain_times.back());
                                   state.SetIterationTime(timing.seconds);
                                 }
                                 const double rays = static_cast<double>(timing.rays) /
                                                     static_cast<double>(plain.rays);
                                 state.SetLabel(std::string(name_of(timing.precision)));
                                 state.counters["without_ns"] = median(plain_times);
                                 state.counters["with_ns"] = median(times);
                                 state.counters["%_a_ray"] = 100 * (median(ratios) - 1);
                                 state.counters["%_a_path"] = 100 * (median(ratios) * rays - 1);
                                 state.counters["%_rays"] = 100 * (rays - 1);
                               })
      ->UseManualTime()
      ->MinTime(0.4)  // shorter measurements are too noisy
      ->Unit(benchmark::kMillisecond);
}

}  // namespace

void register_feature_benchmarks() {
  const std::pair<const char*, Scene> features[] = {
      {"nothing", eight_on_ground()},  // the noise floor of the other results
      {"motion", with_motion()},
      {"transmissive",
       with_material(
           {.color = LinearRgb{1}, .parameter = 1.5, .type = MaterialType::Transmissive})},
      {"specular",
       with_material({.color = LinearRgb{0.8}, .parameter = 0.2, .type = MaterialType::Specular})},
      {"emissive",
       with_material({.color = LinearRgb{1}, .parameter = 2, .type = MaterialType::Emissive})},
      {"gradient", with_gradient()},
      {"lens", with_lens()},
      {"large_ground", eight_on_ground(1e4)},  // which float meets in double
      {"all_but_ground", with_everything()},
  };
  for (const auto& [name, scene] : features) {
    for (const Form& form : forms()) register_feature(name, scene, form);
  }
}

}  // namespace sdlc::bench
