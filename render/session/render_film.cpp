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
          .samples_at_metal = kernel.samples_at_metal,
          .arithmetic = kernel.backend->is_fused ? "fused" : "separate",
          .program = std::move(program)};
}

/// Whether the film has samples from `extent.first_sample` to `end_sample` of its pixels.
bool overlap(const Film& film, const FilmExtent& extent, std::uint32_t end_sample) noexcept {
  const FilmExtent& has = film.extent();
  const bool share_pixels = has.first_pixel < extent.first_pixel + extent.pixels &&
                            extent.first_pixel < has.first_pixel + has.pixels;
  return share_pixels && has.first_sample < end_sample && film.end_sample() > extent.first_sample;
}

/// Whether a film of `part` can be continued as one of `whole`.
bool contains(const FilmExtent& whole, const FilmExtent& part) noexcept {
  return part.first_sample == whole.first_sample && part.replicates == whole.replicates &&
         part.first_pixel >= whole.first_pixel &&
         part.first_pixel + part.pixels <= whole.first_pixel + whole.pixels;
}

/// Copies the samples of films of other pixels to a film that has none.
void copy_samples(std::span<const Film> from, Film& to) {
  if (from.empty()) return;
  const auto offset = [&](const Film& film) {
    return static_cast<std::size_t>(film.extent().first_pixel - to.extent().first_pixel);
  };
  const std::uint32_t replicates = to.extent().replicates;
  std::vector<ReplicateCounts> counts(to.size());
  for (const Film& film : from) {
    for (std::size_t i = 0; i < film.size(); ++i) {
      for (std::uint32_t r = 0; r < replicates; ++r) counts[offset(film) + i][r] = film.count(i, r);
    }
  }
  to.reserve(counts);
  for (const Film& film : from) {
    for (std::size_t i = 0; i < film.size(); ++i) {
      const std::size_t pixel = offset(film) + i;
      for (std::uint32_t r = 0; r < replicates; ++r) {
        if (film.count(i, r) > 0) to.set(pixel, r, film.sum(i, r));
      }
      if (to.channels() != Channels::Color) to.first_hits(pixel) = film.first_hits(i);
    }
  }
}

}  // namespace

Film& film_of(const FilmPart& part, StoredFilm& stored) {
  const auto contained = std::ranges::partition(
      stored.films, [&](const Film& film) { return !contains(part.extent, film.extent()); });
  const std::span<Film> others(stored.films.begin(), contained.begin());
  for (const Film& film : others) {
    if (overlap(film, part.extent, part.end_sample)) {
      throw std::invalid_argument("another film has some of these samples");
    }
  }
  if (contained.size() == 1 && contained.front().extent() == part.extent) return contained.front();
  Film film(part.extent,
            stored.origin.has_first_hits ? Channels::ColorAndFirstHits : Channels::Color);
  copy_samples(contained, film);
  stored.films.erase(contained.begin(), contained.end());
  return stored.films.emplace_back(std::move(film));
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
          .casters = kernel.casters,
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

  Film& film = film_of(part, stored);
  std::vector<ReplicateCounts> targets(film.size());
  for (std::size_t i = 0; i < film.size(); ++i) {
    const std::uint64_t pixel = part.extent.first_pixel + i;
    targets[i] = counts_in(part, samples[samples.size() == 1 ? 0 : pixel]);
  }
  film.reserve(targets);
  PictureTracer pictures(scene.tracer(), settings, emitters, workers.count(), monitor);
  if (monitor.on_tracing) monitor.on_tracing();
  const bool is_whole = workers.run([&] {
    return pictures.trace_pass(
        film, [&](std::size_t pixel) { return targets[pixel]; }, [] { return false; });
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
