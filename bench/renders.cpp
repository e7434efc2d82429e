#include "bench/renders.hpp"

#include <ctime>
#include <memory>
#include <stdexcept>
#include <utility>

#include "render/session/render.hpp"

namespace sdlc::bench {
namespace {

double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec) * 1e-9;
}

}  // namespace

std::vector<Form> forms() {
  std::vector<Form> all{{"scalar", {.backend = &render::portable_backend()}}};
  for (const render::Backend* backend : render::available_vectors()) {
    for (const render::Precision precision :
         {render::Precision::Float, render::Precision::Double}) {
      all.push_back({std::string(backend->name) + "/" + std::string(name_of(precision)),
                     {.search = render::Search::All, .precision = precision, .backend = backend}});
    }
  }
  return all;
}

std::vector<Form> hierarchy_forms() {
  std::vector<Form> all;
  for (Form form : forms()) {
    if (form.request.search != render::Search::All) continue;
    form.request.search = render::Search::Bvh;
    all.push_back({"bvh/" + form.name, form.request});
  }
  return all;
}

Timing time_render(const render::Scene& scene, const Form& form, int depth) {
  // The wide kernel needs many blocks of samples per lane, so that their ends do not matter; the
  // scalar one is slow, and needs fewer.
  const bool is_scalar = form.request.backend == &render::portable_backend();
  const render::RenderSettings settings{.width = is_scalar ? 64 : 256,
                                        .height = is_scalar ? 36 : 144,
                                        .samples = 64,
                                        .depth = depth,
                                        .threads = 1};
  render::RenderMonitor monitor;
  double start = 0;
  monitor.on_tracing = [&] { start = cpu_seconds(); };
  const render::RenderResult result = render::render(scene, settings, monitor, form.request);
  const double seconds = cpu_seconds() - start;
  if (result.kernel.refusal) {
    throw std::runtime_error(describe(result.kernel.refusal->obstacle));
  }
  return {.seconds = seconds,
          .rays = result.rays,
          .paths = result.camera_samples,
          .precision = result.kernel.precision};
}

void register_render(const std::string& name, render::Scene scene, const Form& form, int depth) {
  const auto shared = std::make_shared<const render::Scene>(std::move(scene));
  benchmark::RegisterBenchmark((name + "/" + form.name).c_str(),
                               [shared, form, depth](benchmark::State& state) {
                                 Timing last;
                                 double rays = 0;
                                 for (auto _ : state) {
                                   last = time_render(*shared, form, depth);
                                   rays += static_cast<double>(last.rays);
                                   state.SetIterationTime(last.seconds);
                                 }
                                 using benchmark::Counter;
                                 state.counters["ray"] =
                                     Counter(rays, Counter::kIsRate | Counter::kInvert);
                                 state.counters["rays_a_path"] = static_cast<double>(last.rays) /
                                                                 static_cast<double>(last.paths);
                               })
      ->UseManualTime()
      ->Unit(benchmark::kMillisecond);
}

render::Scene empty_scene() {
  render::Scene scene;
  scene.camera = {.from = {0, 1.5, 6}, .at = {0, 0.3, 0}, .plane_height = 0.7};
  scene.background = {.bottom = render::LinearRgb{0.8}, .top = render::LinearRgb{0.8}};
  return scene;
}

render::Scene eight_on_ground(double ground) {
  render::Scene scene = empty_scene();
  scene.spheres.push_back({.center = {0, -ground, 0}, .radius = ground});
  for (int i = 0; i < 8; ++i) {
    scene.spheres.push_back({.center = {(i % 4 - 1.5) * 0.95, 0.42, 0.5 - i / 4 * 1.0},
                             .radius = 0.4,
                             .material = static_cast<std::uint32_t>(i + 1)});
  }
  scene.materials.assign(scene.spheres.size(), {.color = {0.7, 0.6, 0.5}});
  return scene;
}

}  // namespace sdlc::bench
