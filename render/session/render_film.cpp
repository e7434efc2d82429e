#include "render/session/render_film.hpp"

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "render/parallel/workers.hpp"
#include "render/session/picture_tracer.hpp"
#include "render/shading/emitter_tally.hpp"

namespace sdlc::render {
namespace {

/// The number of samples that a part has in each replicate of a pixel with `samples` samples.
ReplicateCounts counts_in(const FilmPart& part, std::uint64_t samples) {
  ReplicateCounts counts = part.extent.replicates == 1
                               ? ReplicateCounts{static_cast<std::uint32_t>(samples)}
                               : split_in_replicates(samples);
  const std::uint32_t first = part.extent.first_sample;
  for (std::uint32_t& count : counts) {
    const std::uint32_t end = std::min(count, part.end_sample);
    count = end - std::min(first, end);
  }
  return counts;
}

Film& film_of(const FilmPart& part, StoredFilm& stored) {
  const auto known = std::ranges::find(stored.films, part.extent, &Film::extent);
  if (known != stored.films.end()) return *known;
  return stored.films.emplace_back(
      part.extent, stored.origin.has_first_hits ? Channels::ColorAndFirstHits : Channels::Color);
}

}  // namespace

StoredFilm new_film(const PreparedScene& scene, std::uint64_t digest,
                    const RenderSettings& settings) {
  const Kernel& kernel = scene.kernel();
  return {.origin = {.scene = digest,
                     .width = static_cast<std::uint32_t>(settings.width),
                     .height = static_cast<std::uint32_t>(settings.height),
                     .depth = static_cast<std::uint32_t>(settings.depth),
                     .seed = settings.seed,
                     .sampler = settings.sampler,
                     .is_centred = settings.is_centred(),
                     .has_first_hits = settings.keeps_first_hits,
                     .precision = kernel.precision,
                     .arithmetic = kernel.backend->is_fused ? "fused" : "separate",
                     .program = {}},
          .statistics = {},
          .lights = kernel.lights,
          .exact_spheres = kernel.exact_spheres,
          .emitters = EmitterTally(scene.emitters(), settings.depth).counts(),
          .targets = {},
          .films = {}};
}

bool render_part(const PreparedScene& scene, const RenderSettings& settings, RenderMonitor& monitor,
                 const FilmPart& part, std::span<const std::uint32_t> samples, StoredFilm& stored) {
  Workers workers(settings.threads);
  EmitterTally emitters(scene.emitters(), settings.depth);
  emitters.restore(stored.emitters);

  Film& film = film_of(part, stored);
  std::vector<ReplicateCounts> targets(film.size());
  std::uint64_t added = 0;
  for (std::size_t i = 0; i < film.size(); ++i) {
    const std::uint64_t pixel = part.extent.first_pixel + i;
    targets[i] = counts_in(part, samples[samples.size() == 1 ? 0 : pixel]);
    std::uint64_t target = 0;
    for (const std::uint32_t count : targets[i]) target += count;
    added = std::max(added, target - std::min(target, film.samples(i)));
  }
  film.reserve(targets);
  PictureTracer pictures(scene.tracer(), settings, emitters, workers.count(), monitor);
  const std::uint64_t rays = monitor.rays_done.load();
  const bool is_whole = workers.run([&] {
    return pictures.trace_pass(
        film, added, [&](std::size_t pixel) { return targets[pixel]; }, [] { return false; });
  });
  stored.statistics.rays += monitor.rays_done.load() - rays;
  stored.statistics.truncated_paths += pictures.truncated_paths();
  stored.statistics.nonfinite_samples += pictures.nonfinite_samples();
  stored.emitters = emitters.counts();
  return is_whole;
}

Picture picture_of(const StoredFilm& stored) {
  Picture picture(static_cast<int>(stored.origin.width), static_cast<int>(stored.origin.height));
  for (const Film& film : stored.films) {
    if (film.extent().first_sample != 0) {
      throw std::invalid_argument("the film lacks the first samples");
    }
    for (std::size_t i = 0; i < film.size(); ++i) {
      picture.pixels[film.extent().first_pixel + i] = film.mean(i);
    }
  }
  return picture;
}

}  // namespace sdlc::render
