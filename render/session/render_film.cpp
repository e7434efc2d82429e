#include "render/session/render_film.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "render/parallel/workers.hpp"
#include "render/session/error_goal.hpp"
#include "render/session/film_keeper.hpp"
#include "render/session/goal_render.hpp"
#include "render/session/picture_tracer.hpp"
#include "render/shading/emitter_tally.hpp"

namespace sdlc::render {
namespace {

FilmOrigin origin_of(const PreparedScene& scene, const SceneDigest& digest, std::string program,
                     const RenderSettings& settings) {
  const Kernel& kernel = scene.kernel();
  return {.scene = digest,
          .width = static_cast<std::uint32_t>(settings.width),
          .height = static_cast<std::uint32_t>(settings.height),
          .crop = settings.window(),
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

/// Adds what settings and kernel say.
PictureRecord completed(PictureRecord record, const PreparedScene& scene,
                        const RenderSettings& settings) {
  record.samples = settings.samples;
  record.error = settings.error.value_or(0);
  record.is_adaptive = settings.is_adaptive;
  record.is_denoised = settings.is_denoised;
  record.light_sampling = settings.light_sampling;
  record.light_choice = scene.kernel().light_choice;
  record.may_have_casters = scene.kernel().may_have_casters;
  record.depth_exponent = scene.tracer().depth_exponent();
  return record;
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

/// The film that has the first samples of all pixels; null if there is none, or another beside it.
const Film* whole_film(const StoredFilm& stored, std::size_t pixels) noexcept {
  if (stored.films.size() != 1) return nullptr;
  const FilmExtent& extent = stored.films[0].extent();
  return extent.pixels == pixels && extent.first_sample == 0 ? &stored.films[0] : nullptr;
}

/// The means of all samples of each pixel. Returns their number.
std::uint64_t put_means(std::span<const Film> films, Picture& picture) {
  std::vector<std::uint64_t> samples(picture.pixels.size());
  std::uint64_t total = 0;
  for (const Film& film : films) {
    for (std::size_t i = 0; i < film.size(); ++i) {
      const std::uint64_t added = film.samples(i);
      if (added == 0) continue;
      const std::size_t pixel = film.extent().first_pixel + i;
      total += added;
      samples[pixel] += added;
      const double share = static_cast<double>(added) / static_cast<double>(samples[pixel]);
      LinearRgb& mean = picture.pixels[pixel];
      mean = mean * (1 - share) + film.mean(i) * share;
    }
  }
  return total;
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

StoredFilm new_film(const PreparedScene& scene, const SceneDigest& digest, std::string program,
                    const RenderSettings& settings, PictureRecord record) {
  const Kernel& kernel = scene.kernel();
  EmitterClasses classes = scene.emitters();
  classes.of_spheres.assign(classes.of_spheres.size(), EmitterClasses::kNone);
  return {.origin = origin_of(scene, digest, std::move(program), settings),
          .record = completed(std::move(record), scene, settings),
          .shards = {},
          .statistics = {},
          .lights = kernel.lights,
          .casters = kernel.casters,
          .exact_spheres = kernel.exact_spheres,
          .emitter_classes = std::move(classes),
          .emitters = EmitterTally(scene.emitters(), settings.depth).counts(),
          .targets = {},
          .passes = {},
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
  FilmKeeper keeper(pictures, emitters, monitor, stored);
  if (monitor.on_tracing) monitor.on_tracing();
  const bool is_whole = workers.run([&] {
    return pictures.trace_pass(
        film, [&](std::size_t pixel) { return targets[pixel]; }, [] { return false; });
  });
  if (monitor.on_pass) monitor.on_pass(film, [] { return ErrorSoFar{}; });
  keeper.keep();
  return is_whole;
}

RenderSettings settings_of(const StoredFilm& stored) {
  const auto& [origin, record] = std::tie(stored.origin, stored.record);
  RenderSettings settings{.width = static_cast<int>(origin.width),
                          .height = static_cast<int>(origin.height),
                          .samples = record.samples,
                          .depth = static_cast<int>(origin.depth)};
  if (origin.crop != settings.window()) settings.crop = origin.crop;
  settings.seed = origin.seed;
  settings.sampler = origin.sampler;
  settings.light_sampling = record.light_sampling;
  if (record.error > 0) settings.error = record.error;
  settings.is_adaptive = record.is_adaptive;
  settings.keeps_first_hits = origin.has_first_hits;
  settings.keeps_variance = origin.replicates > 1;
  return settings;
}

RenderResult result_of(const StoredFilm& stored) {
  const RenderSettings settings = settings_of(stored);
  RenderResult result;
  result.picture = Picture(settings.window().width, settings.window().height);
  result.kernel.precision = stored.origin.precision;
  result.kernel.lights = stored.lights;
  result.kernel.casters = stored.casters;
  result.kernel.exact_spheres = stored.exact_spheres;
  result.kernel.samples_at_metal = stored.origin.samples_at_metal;
  result.kernel.light_choice = stored.record.light_choice;
  result.kernel.may_have_casters = stored.record.may_have_casters;
  put_counts(stored.statistics, result);

  const std::size_t pixels = result.picture.pixels.size();
  const Film* whole = whole_film(stored, pixels);
  if (whole == nullptr) {
    result.camera_samples = put_means(stored.films, result.picture);
    return result;
  }
  const Film& film = *whole;
  const SampleCounts counts = film.sample_counts();
  result.is_complete = counts.min > 0;
  result.min_samples = counts.min;
  result.max_samples = counts.max;
  const bool is_known = film.extent().replicates > 1 && counts.min >= kMinReplicatedSamples;
  if (is_known) result.variance = Picture(settings.window().width, settings.window().height);
  result.camera_samples = film.samples();
  for (std::size_t i = 0; i < pixels; ++i) {
    result.picture.pixels[i] = film.mean(i);
    if (is_known) {
      result.spreads.push_back(film.spread(i));
      result.variance.pixels[i] = film.variance(i);
    }
    if (settings.keeps_first_hits) {
      result.features.push_back(
          features_of(film.first_hits(i), film.samples(i), stored.record.depth_exponent));
    }
    if (counts.min != counts.max) {
      result.samples_of_pixels.push_back(static_cast<std::uint32_t>(film.samples(i)));
    }
  }
  if (!result.is_complete) return result;
  if (is_known) result.error = estimate_error(result.picture, result.spreads);
  EmitterTally emitters(stored.emitter_classes, settings.depth);
  emitters.restore(stored.emitters);
  if (settings.error && result.error) {
    ErrorGoal goal(*settings.error, static_cast<std::uint64_t>(settings.samples));
    goal.restore(stored.passes);
    if (!settings.is_adaptive) result.error = goal.settled(counts.min, *result.error);
    result.has_reached_error =
        goal.is_reached(*result.error) && !may_see_more(goal, emitters, counts.min);
  }
  check_error(emitters, result);
  return result;
}

}  // namespace sdlc::render
