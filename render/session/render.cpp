#include "render/session/render.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "render/film/film.hpp"
#include "render/math/clock.hpp"
#include "render/parallel/workers.hpp"
#include "render/session/film_keeper.hpp"
#include "render/session/goal_render.hpp"
#include "render/session/picture_denoiser.hpp"
#include "render/session/picture_tracer.hpp"
#include "render/session/render_film.hpp"
#include "render/shading/emitter_tally.hpp"

namespace sdlc::render {
namespace {

/// Renders without a goal. `film` may be null if `denoiser` is.
void render_at_once(PictureTracer& pictures, const Tracer& tracer, const RenderSettings& settings,
                    const RenderMonitor& monitor, const PictureDenoiser* denoiser, Film* film,
                    RenderResult& result) {
  const auto samples = static_cast<std::uint64_t>(settings.samples);
  const FilmExtent extent = extent_of(settings);
  const bool has_replicates = extent.replicates > 1;
  const ReplicateCounts target = has_replicates
                                     ? split_in_replicates(samples)
                                     : ReplicateCounts{static_cast<std::uint32_t>(samples)};
  std::vector<PixelSpread> spreads(has_replicates ? extent.pixels : 0);
  if (has_replicates && settings.keeps_variance) {
    result.variance = Picture(settings.window().width, settings.window().height);
  }
  if (settings.keeps_first_hits) result.features.resize(extent.pixels);
  const auto take_tile = [&](const Film& tile, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::size_t pixel = tile.extent().first_pixel + i;
      result.picture.pixels[pixel] = tile.mean(i);
      if (!spreads.empty()) spreads[pixel] = tile.spread(i);
      if (!result.variance.pixels.empty()) result.variance.pixels[pixel] = tile.variance(i);
      if (settings.keeps_first_hits) {
        result.features[pixel] =
            features_of(tile.first_hits(i), tile.samples(i), tracer.depth_exponent());
      }
    }
  };
  if (film == nullptr) {
    pictures.trace_tiles(extent, target, take_tile);
  } else {
    film->reserve(std::span(&target, 1));
    pictures.trace_pass(
        *film, [&](std::size_t) { return target; }, [] { return false; }, take_tile);
  }
  const SampleCounts counts =
      film != nullptr ? film->sample_counts() : SampleCounts{.min = samples, .max = samples};
  result.max_samples = std::max(samples, counts.max);
  if (monitor.cancel.load()) return;  // some pixels have no sample
  result.min_samples = counts.min;
  if (has_replicates) result.error = estimate_error(result.picture, spreads);
  if (denoiser != nullptr && result.error) denoiser->denoise(*film, spreads, result);
  if (settings.keeps_variance) result.spreads = std::move(spreads);
}

/// Makes the picture what it was before it was denoised, if it was. Then no goal is reached:
/// ErrorGoal did not go by the plain picture.
void restore_plain(const Film* film, RenderResult& result) {
  if (!result.plain_error) return;
  for (std::size_t i = 0; i < film->size(); ++i) result.picture.pixels[i] = film->mean(i);
  result.error = std::exchange(result.plain_error, std::nullopt);
  result.has_reached_error = false;
}

/// RenderSettings::seconds counts from `start`. `film` may be null.
RenderResult render_since(Clock::time_point start, const PreparedScene& scene,
                          const RenderSettings& settings, RenderMonitor& monitor,
                          StoredFilm* stored) {
  if (stored != nullptr) check_origin(scene, settings, *stored);
  Film* film = stored != nullptr ? &film_of({.extent = extent_of(settings)}, *stored) : nullptr;
  std::optional<Film> own;
  if (film == nullptr && (settings.has_goal() || settings.is_denoised || monitor.on_pass)) {
    film = &own.emplace(extent_of(settings), channels_of(settings));
  }
  RenderResult result;
  result.picture = Picture(settings.window().width, settings.window().height);
  result.kernel = scene.kernel();
  result.build_seconds = scene.build_seconds();
  result.bvh_bytes = scene.memory_bytes();
  Workers workers(settings.threads);
  result.threads = workers.count();
  EmitterTally emitters(scene.emitters(), settings.depth);
  const TraceCounts before = stored != nullptr ? stored->statistics : TraceCounts{};
  if (stored != nullptr) emitters.restore(stored->emitters);
  if (monitor.on_tracing) monitor.on_tracing();

  const auto render_start = Clock::now();
  PictureTracer pictures(scene.tracer(), settings, emitters, result.threads, monitor);
  workers.run([&] {
    std::optional<PictureDenoiser> denoiser;
    if (settings.is_denoised) {
      denoiser.emplace(scene, settings, result.threads, monitor);
      result.denoise_seconds = seconds_since(render_start);
    }
    const bool has_passes = monitor.shows_passes && extent_of(settings).replicates > 1;
    if (settings.has_goal() || has_passes) {
      GoalRender goal(pictures, settings, emitters, start, monitor, *film, result);
      if (denoiser) goal.denoise_with(*denoiser);
      std::optional<FilmKeeper> keeper;
      if (stored != nullptr) {
        goal.resume(std::move(stored->targets), std::move(stored->passes));
        keeper.emplace(pictures, emitters, monitor, *stored, [&] {
          stored->targets = goal.targets();
          stored->passes = goal.passes();
        });
      }
      goal.run();
      if (keeper) keeper->keep();
      if (settings.keeps_first_hits && !monitor.is_dropped()) {
        for (std::size_t i = 0; i < film->size(); ++i) {
          result.features.push_back(
              features_of(film->first_hits(i), film->samples(i), scene.tracer().depth_exponent()));
        }
      }
    } else {
      std::optional<FilmKeeper> keeper;
      if (stored != nullptr) keeper.emplace(pictures, emitters, monitor, *stored);
      render_at_once(pictures, scene.tracer(), settings, monitor, denoiser ? &*denoiser : nullptr,
                     film, result);
      if (keeper) keeper->keep();
      if (monitor.on_pass) {
        monitor.on_pass(*film, [&] { return known_error(result, emitters); });
      }
    }
  });
  result.render_seconds = seconds_since(render_start);
  result.is_complete = !monitor.cancel.load();
  if (!result.is_complete || has_unseen_error(result, emitters)) restore_plain(film, result);
  if (!result.is_complete) result.error.reset();
  result.new_samples = pictures.samples();
  result.camera_samples = stored != nullptr ? film->samples() : pictures.samples();
  TraceCounts counts = before;
  counts += pictures.counts();
  put_counts(counts, result);
  check_error(emitters, result);
  return result;
}

}  // namespace

void put_counts(const TraceCounts& counts, RenderResult& result) noexcept {
  result.rays = counts.rays;
  result.truncated_paths = counts.truncated_paths;
  result.nonfinite_samples = counts.nonfinite_samples;
}

void check_error(const EmitterTally& emitters, RenderResult& result) {
  ErrorSoFar known = known_error(result, emitters);
  result.rare_paths = std::move(known.rare_paths);
  if (result.error && !known.error) {
    result.error.reset();
    result.has_reached_error = false;
  }
  result.scarce_emitters = std::move(known.scarce_emitters);
  result.sampled_lights = static_cast<std::uint32_t>(result.kernel.lights.size());
}

FilmExtent extent_of(const RenderSettings& settings) noexcept {
  const bool has_replicates =
      settings.has_goal() || settings.samples >= static_cast<int>(kMinReplicatedSamples);
  return {.pixels = settings.window().pixels(), .replicates = has_replicates ? kReplicates : 1};
}

Channels channels_of(const RenderSettings& settings) noexcept {
  return settings.keeps_first_hits ? Channels::ColorAndFirstHits : Channels::Color;
}

RenderResult render(const PreparedScene& scene, const RenderSettings& settings,
                    RenderMonitor& monitor, StoredFilm* film, Clock::time_point start) {
  return render_since(start, scene, settings, monitor, film);
}

RenderResult render(Kernel kernel, Scene scene, const RenderSettings& settings,
                    RenderMonitor& monitor) {
  const auto start = Clock::now();
  const PreparedScene prepared(std::move(kernel), std::move(scene), settings.threads);
  return render_since(start, prepared, settings, monitor, nullptr);
}

RenderResult render(Scene scene, const RenderSettings& settings, RenderMonitor& monitor,
                    const KernelRequest& request) {
  const auto start = Clock::now();
  const PreparedScene prepared = prepare(std::move(scene), settings, request);
  return render_since(start, prepared, settings, monitor, nullptr);
}

}  // namespace sdlc::render
