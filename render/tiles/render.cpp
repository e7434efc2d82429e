#include "render/tiles/render.hpp"

#include <chrono>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "render/film/film.hpp"
#include "render/light/emitter_tally.hpp"
#include "render/tiles/goal_render.hpp"
#include "render/tiles/picture_tracer.hpp"
#include "render/tiles/tracer.hpp"
#include "render/tiles/workers.hpp"

namespace sdlc::render {
namespace {

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Renders without a goal. `film` may be null.
void render_at_once(PictureTracer& tracer, const RenderSettings& settings,
                    const RenderMonitor& monitor, Film* film, RenderResult& result) {
  const auto samples = static_cast<std::uint64_t>(settings.samples);
  result.max_samples = samples;
  const FilmExtent extent = extent_of(settings);
  const bool has_replicates = extent.replicates > 1;
  const ReplicateCounts target = has_replicates
                                     ? split_in_replicates(samples)
                                     : ReplicateCounts{static_cast<std::uint32_t>(samples)};
  std::vector<PixelSpread> spreads(has_replicates ? extent.pixels : 0);
  if (has_replicates && settings.keeps_variance) {
    result.variance = Picture(settings.width, settings.height);
  }
  const auto take_tile = [&](const Film& tile, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::size_t pixel = tile.extent().first_pixel + i;
      result.picture.pixels[pixel] = tile.mean(i);
      if (!spreads.empty()) spreads[pixel] = tile.spread(i);
      if (!result.variance.pixels.empty()) result.variance.pixels[pixel] = tile.variance(i);
    }
  };
  if (film == nullptr) {
    tracer.trace_tiles(extent, target, take_tile);
  } else {
    film->reserve(std::span(&target, 1));
    tracer.trace_pass(
        *film, samples, [&](std::size_t) { return target; }, [] { return false; }, take_tile);
  }
  if (monitor.cancel.load()) return;  // some pixels have no sample
  result.min_samples = samples;
  if (has_replicates) result.error = estimate_error(result.picture, spreads);
  if (settings.keeps_variance) result.spreads = std::move(spreads);
}

}  // namespace

FilmExtent extent_of(const RenderSettings& settings) noexcept {
  const bool has_replicates =
      settings.has_goal() || settings.samples >= static_cast<int>(kMinReplicatedSamples);
  return {.pixels =
              static_cast<std::size_t>(settings.width) * static_cast<std::size_t>(settings.height),
          .replicates = has_replicates ? kReplicates : 1};
}

RenderResult render(Scene scene, const RenderSettings& settings, RenderMonitor& monitor,
                    const KernelRequest& request) {
  const auto start = std::chrono::steady_clock::now();
  Kernel kernel = choose_kernel(scene, settings, request);
  const double choice_seconds = seconds_since(start);
  RenderResult result = render(std::move(kernel), std::move(scene), settings, monitor);
  result.build_seconds += choice_seconds;
  return result;
}

RenderResult render(Kernel kernel, Scene scene, const RenderSettings& settings,
                    RenderMonitor& monitor) {
  return render(std::move(kernel), std::move(scene), settings, monitor, nullptr);
}

RenderResult render(Kernel kernel, Scene scene, const RenderSettings& settings,
                    RenderMonitor& monitor, Film* film) {
  const auto start = std::chrono::steady_clock::now();
  std::optional<Film> own;
  if (film == nullptr && (settings.has_goal() || monitor.on_pass)) {
    film = &own.emplace(extent_of(settings));
  }
  RenderResult result;
  result.picture = Picture(settings.width, settings.height);
  Workers workers(settings.threads);
  result.threads = workers.count();
  const auto build_start = std::chrono::steady_clock::now();
  result.kernel = std::move(kernel);
  EmitterTally emitters(scene, result.kernel.lights, settings.depth);
  const std::unique_ptr<const Tracer> tracer =
      workers.run([&] { return make_tracer(result.kernel, std::move(scene), settings, emitters); });
  result.kernel.bounds.near_pairs.reset();  // for a lattice of touching spheres it is larger than
                                            // the spheres
  result.build_seconds = seconds_since(build_start);
  result.bvh_bytes = tracer->memory_bytes();
  if (monitor.on_tracing) monitor.on_tracing();

  const auto render_start = std::chrono::steady_clock::now();
  PictureTracer pictures(*tracer, settings, result.threads, monitor);
  workers.run([&] {
    if (settings.has_goal()) {
      GoalRender(pictures, settings, emitters, start, monitor, *film, result).run();
    } else {
      render_at_once(pictures, settings, monitor, film, result);
      if (monitor.on_pass) monitor.on_pass(*film);
    }
  });
  result.render_seconds = seconds_since(render_start);
  result.is_complete = !monitor.cancel.load();
  if (!result.is_complete) result.error.reset();
  if (has_unseen_error(result, emitters)) {
    result.rare_paths = emitters.rare();
    result.error.reset();
    result.has_reached_error = false;
  }
  result.camera_samples = monitor.samples_done.load();
  result.rays = monitor.rays_done.load();
  result.truncated_paths = pictures.truncated_paths();
  result.nonfinite_samples = pictures.nonfinite_samples();
  result.scarce_emitters = emitters.scarce();
  result.sampled_lights = static_cast<std::uint32_t>(result.kernel.lights.size());
  return result;
}

}  // namespace sdlc::render
