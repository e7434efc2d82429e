#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/environment.hpp"
#include "cli/shard_option.hpp"
#include "render/film/film_file.hpp"
#include "render/session/render.hpp"
#include "render/session/render_film.hpp"
#include "render/session/shards.hpp"

namespace sdlc::cli {

/// What the film of a render is for.
struct FilmRequest {
  /// The film files to write; the first also has the checkpoints. If there is none, `checkpoint`
  /// has them, and is removed at the end.
  std::vector<std::filesystem::path> outputs;
  std::filesystem::path checkpoint;
  std::optional<double> checkpoint_seconds;  ///< between two of them
  bool resumes = false;                      ///< goes on from the checkpoint if it is there
  std::optional<Shard> shard;                ///< of the samples or pixels, by `cut`
  render::ShardCut cut{};
};

/// A render whose samples are kept in a film.
class FilmJob {
 public:
  /// Prepares the scene, and reads what is resumed. `record`: what a new film does not know. Throws
  /// FilmError if the film to resume is of another picture, and IoError.
  FilmJob(FilmRequest request, render::Kernel kernel, render::Scene scene,
          const render::RenderSettings& settings, const render::PictureRecord& record);

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

  bool is_shard() const noexcept { return request_.shard.has_value(); }
  /// "shard 2 of 8 of the samples".
  std::string name_of_shard() const;
  /// All samples of the render, without a goal.
  std::uint64_t samples() const noexcept { return render::samples_in(part_, settings_); }

 private:
  void resume();
  render::RenderResult render_shard(render::RenderMonitor& monitor);

  FilmRequest request_;
  render::RenderSettings settings_;
  render::SceneDigest digest_;
  render::PreparedScene scene_;
  render::StoredFilm film_;
  render::FilmPart part_;
  bool is_kept_ = false;  // the film was finished when it was read
};

}  // namespace sdlc::cli
