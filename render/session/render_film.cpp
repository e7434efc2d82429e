#include "render/session/render_film.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>
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

FilmOrigin origin_of(const PreparedScene& scene, std::uint64_t digest, std::string program,
                     const RenderSettings& settings) {
  const Kernel& kernel = scene.kernel();
  return {.scene = digest,
          .width = static_cast<std::uint32_t>(settings.width),
          .height = static_cast<std::uint32_t>(settings.height),
          .depth = static_cast<std::uint32_t>(settings.depth),
          .seed = settings.seed,
          .sampler = settings.sampler,
          .is_centred = settings.is_centred(),
          .replicates = extent_of(settings).replicates,
          .has_first_hits = settings.keeps_first_hits,
          .precision = kernel.precision,
          .arithmetic = kernel.backend->is_fused ? "fused" : "separate",
          .program = std::move(program)};
}

bool overlap(const FilmExtent& a, const FilmExtent& b) noexcept {
  return a.first_pixel < b.first_pixel + b.pixels && b.first_pixel < a.first_pixel + a.pixels;
}

}  // namespace

Film& film_of(const FilmExtent& extent, StoredFilm& stored) {
  const auto known = std::ranges::find(stored.films, extent, &Film::extent);
  if (known != stored.films.end()) return *known;
  for (const Film& film : stored.films) {
    if (film.extent().first_sample == extent.first_sample && overlap(film.extent(), extent)) {
      throw std::invalid_argument("a film of other pixels has some of these samples");
    }
  }
  return stored.films.emplace_back(
      extent, stored.origin.has_first_hits ? Channels::ColorAndFirstHits : Channels::Color);
}

void check_origin(const PreparedScene& scene, const RenderSettings& settings,
                  const StoredFilm& stored) {
  const FilmOrigin& origin = stored.origin;
  const std::string other =
      difference(stored, new_film(scene, origin.scene, origin.program, settings));
  if (!other.empty()) throw std::invalid_argument("the film is of another picture: " + other);
}

void store(const PictureTracer& pictures, const EmitterTally& emitters, StoredFilm& stored) {
  stored.statistics += pictures.counts();
  if (!pictures.has_dropped()) stored.emitters = emitters.counts();
}

StoredFilm new_film(const PreparedScene& scene, std::uint64_t digest, std::string program,
                    const RenderSettings& settings) {
  const Kernel& kernel = scene.kernel();
  return {.origin = origin_of(scene, digest, std::move(program), settings),
          .statistics = {},
          .lights = kernel.lights,
          .exact_spheres = kernel.exact_spheres,
          .emitters = EmitterTally(scene.emitters(), settings.depth).counts(),
          .targets = {},
          .films = {}};
}

bool render_part(const PreparedScene& scene, const RenderSettings& settings, RenderMonitor& monitor,
                 const FilmPart& part, std::span<const std::uint32_t> samples, StoredFilm& stored) {
  check_origin(scene, settings, stored);
  Workers workers(settings.threads);
  EmitterTally emitters(scene.emitters(), settings.depth);
  emitters.restore(stored.emitters);

  Film& film = film_of(part.extent, stored);
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
  if (monitor.on_tracing) monitor.on_tracing();
  const bool is_whole = workers.run([&] {
    return pictures.trace_pass(
        film, added, [&](std::size_t pixel) { return targets[pixel]; }, [] { return false; });
  });
  if (monitor.on_pass) monitor.on_pass(film);
  store(pictures, emitters, stored);
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
