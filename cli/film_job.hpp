#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "cli/environment.hpp"
#include "cli/film_request.hpp"
#include "render/film/film_file.hpp"
#include "render/math/clock.hpp"
#include "render/session/render.hpp"
#include "render/session/render_film.hpp"
#include "render/session/shards.hpp"

namespace sdlc::cli {

/// A render whose samples are kept in a film.
class FilmJob {
 public:
  /// Prepares the scene, and reads what is resumed. `record`: what settings and kernel do not say.
  /// Throws FilmError if the film to resume cannot be used, and IoError. A damaged one of a video
  /// is replaced, with a warning.
  FilmJob(FilmRequest request, render::Kernel kernel, render::Scene scene,
          const render::RenderSettings& settings, render::PictureRecord record, Environment& env);

  /// The samples that are not in the film yet.
  std::uint64_t samples_to_trace() const noexcept;
  /// Calls RenderMonitor::on_tracing and writes checkpoints; a failure to write one is reported.
  /// The picture of a shard is empty.
  render::RenderResult render(render::RenderMonitor& monitor, Environment& env);
  /// The films to write in the end. Without any, the checkpoint if it is needed any more; otherwise
  /// it is removed, unless the user has kept that film before.
  std::vector<std::filesystem::path> finish(bool is_complete, bool is_picture_written);
  /// Throws IoError.
  void write(const std::filesystem::path& path) const { write_film_file(path, film_); }

  const render::StoredFilm& film() const noexcept { return film_; }
  bool is_shard() const noexcept { return request_.shard.has_value(); }
  /// "shard 2 of 8 of the samples".
  std::string name_of_shard() const;
  /// All samples of the render, without a goal.
  std::uint64_t samples() const noexcept { return render::samples_in(part_, settings_); }

 private:
  void resume(Environment& env);
  render::RenderResult render_shard(render::RenderMonitor& monitor);

  const render::Clock::time_point start_;  // RenderSettings::seconds counts from here
  FilmRequest request_;
  render::RenderSettings settings_;
  render::SceneDigest digest_;
  render::PreparedScene scene_;
  render::StoredFilm film_;
  render::FilmPart part_;
  bool is_kept_ = false;  // the film was finished when it was read
};

}  // namespace sdlc::cli
