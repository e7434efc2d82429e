#include "cli/film_job.hpp"

#include <algorithm>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "cli/report_failure.hpp"
#include "cli/version.hpp"
#include "render/film/film.hpp"
#include "render/image/io_error.hpp"
#include "render/math/clock.hpp"
#include "render/parallel/threads.hpp"
#include "render/session/shards.hpp"

namespace sdlc::cli {
namespace {

namespace fs = std::filesystem;

std::uint64_t samples_in(const render::StoredFilm& stored) {
  std::uint64_t samples = 0;
  for (const render::Film& film : stored.films) samples += film.samples();
  return samples;
}

/// Why a render with the record `wanted` cannot go on from the film, as a clause; empty if it can.
std::string obstacle(const render::StoredFilm& film, const render::StoredFilm& wanted,
                     const render::FilmPart& part) {
  std::string other = difference(film, wanted);
  if (!other.empty()) return other;
  const render::PictureRecord &has = film.record, &wants = wanted.record;
  const bool is_whole = missing_shards(film).empty();
  if (wants.error > 0 && has.error == 0 && !is_whole) {
    return "it is not finished, and was begun without --error";
  }
  if (wants.shards == 1 && has.shards > 1 && !is_whole) return "it has only some of its shards";
  if (wants.shards > 1 && (has.shards != wants.shards || has.cut != wants.cut)) {
    return "it is divided into other shards";
  }
  if (wants.shards > 1 && has.samples != wants.samples) {
    return fmt::format("its shards are those of {} samples, not {}", has.samples, wants.samples);
  }
  std::uint64_t max = 0;
  for (const render::Film& each : film.films) {
    if (wants.shards > 1 && each.extent() != part.extent) return "it is another shard";
    if (each.size() > 0) max = std::max(max, each.sample_counts().max);
  }
  if (max > static_cast<std::uint64_t>(wants.samples)) {
    return fmt::format("it has {} samples per pixel, more than {}", max, wants.samples);
  }
  if (!film.targets.empty()) {
    if (has.error != wants.error || !wants.is_adaptive) {
      return fmt::format("its samples were distributed for --error {}% --adaptive",
                         100 * has.error);
    }
    if (has.samples != wants.samples) {
      return fmt::format("its samples were distributed with --samples {}", has.samples);
    }
  } else if (wants.is_adaptive && !has.is_adaptive && max > 0) {
    return "it was rendered without --adaptive";
  }
  return {};
}

}  // namespace

FilmJob::FilmJob(FilmRequest request, render::Kernel kernel, render::Scene scene,
                 const render::RenderSettings& settings, render::PictureRecord record,
                 Environment& env)
    : start_(render::Clock::now()),
      request_(std::move(request)),
      settings_(settings),
      digest_(digest_of_parts(scene)),
      scene_(std::move(kernel), std::move(scene), settings.threads),
      film_(
          new_film(scene_, digest_, fmt::format("sdlc {}", kVersion), settings, std::move(record))),
      part_(request_.shard ? render::shard(settings, request_.cut, request_.shard->index,
                                           request_.shard->count)
                           : render::FilmPart{.extent = extent_of(settings)}) {
  if (request_.resumes) resume(env);
}

void FilmJob::resume(Environment& env) {
  const fs::path& path = request_.checkpoint;
  std::error_code error;
  const bool is_there = fs::exists(path, error);
  if (error) throw render::IoError("read", path, error);
  if (!is_there) return;
  using render::FilmError;
  const auto refuse = [&](FilmError::Reason reason, const std::string& cause) {
    const char* const advice = request_.is_of_video
                                   ? "; remove the folder to begin again"
                                   : "; remove the film, or omit --resume, to begin again";
    throw FilmError(reason, path, cause + advice);
  };
  render::StoredFilm earlier;
  try {
    earlier = render::read_film_file(path);
  } catch (const FilmError& failure) {
    if (request_.is_of_video) {  // the frame is rendered again
      warn(failure, env);
      return;
    }
    refuse(failure.reason(), failure.cause());
  }
  const std::string other = obstacle(earlier, film_, part_);
  if (!other.empty()) {
    refuse(FilmError::Reason::Foreign, "the render cannot go on from this film: " + other);
  }
  is_kept_ = !earlier.shards.empty();
  film_.statistics = earlier.statistics;
  film_.emitters = std::move(earlier.emitters);
  film_.targets = std::move(earlier.targets);
  // Whether a goal is reached was decided for another picture.
  if (earlier.record.is_denoised == film_.record.is_denoised) {
    film_.passes = std::move(earlier.passes);
  }
  film_.films = std::move(earlier.films);
}

std::string FilmJob::name_of_shard() const {
  return fmt::format("shard {} of {} of the {}", request_.shard->index, request_.shard->count,
                     name_of(request_.cut));
}

std::uint64_t FilmJob::samples_to_trace() const noexcept {
  const std::uint64_t all = samples(), present = samples_in(film_);
  return all - std::min(all, present);
}

render::RenderResult FilmJob::render(render::RenderMonitor& monitor, Environment& env) {
  if (request_.checkpoint_seconds) {
    monitor.checkpoint_seconds = *request_.checkpoint_seconds;
    monitor.on_checkpoint = [&](const render::StoredFilm& film) {
      try {
        write_film_file(request_.checkpoint, film);
      } catch (const render::IoError& error) {  // the next one may succeed
        warn(error, env);
      }
    };
  }
  if (request_.shard) return render_shard(monitor);
  return render::render(scene_, settings_, monitor, &film_, start_);
}

render::RenderResult FilmJob::render_shard(render::RenderMonitor& monitor) {
  const auto samples = static_cast<std::uint32_t>(settings_.samples);
  const std::uint64_t before = samples_in(film_);
  const auto start = render::Clock::now();
  render::RenderResult result;
  result.is_complete =
      render_part(scene_, settings_, monitor, part_, std::span(&samples, 1), film_);
  result.render_seconds = render::seconds_since(start);
  result.build_seconds = scene_.build_seconds();
  result.bvh_bytes = scene_.memory_bytes();
  result.kernel = scene_.kernel();
  result.threads = render::wanted_threads(settings_.threads);
  result.camera_samples = samples_in(film_);
  result.new_samples = result.camera_samples - before;
  put_counts(film_.statistics, result);
  return result;
}

std::vector<fs::path> FilmJob::finish(bool is_complete, bool is_picture_written) {
  if (is_complete) film_.shards = {request_.shard ? request_.shard->index : 1};
  if (!request_.outputs.empty()) return request_.outputs;
  if (!is_picture_written || is_kept_) return {request_.checkpoint};
  fs::remove(request_.checkpoint);
  return {};
}

}  // namespace sdlc::cli
