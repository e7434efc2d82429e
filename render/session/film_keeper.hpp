#pragma once

#include <functional>

#include "render/film/film_file.hpp"
#include "render/session/picture_tracer.hpp"
#include "render/session/render.hpp"
#include "render/shading/emitter_tally.hpp"

namespace sdlc::render {

/// Brings what a film has beside its samples up to date: for checkpoints, and at the end.
class FilmKeeper {
 public:
  /// Keeps references to all arguments. Calls RenderMonitor::on_checkpoint from now on. `keep_goal`
  /// keeps what the goal has found.
  FilmKeeper(PictureTracer& pictures, const EmitterTally& emitters, const RenderMonitor& monitor,
             StoredFilm& stored, std::function<void()> keep_goal = {});
  FilmKeeper(const FilmKeeper&) = delete;
  FilmKeeper& operator=(const FilmKeeper&) = delete;

  /// If the render dropped samples, emitters are as before: too few paths are counted then, so that
  /// no error is called known that is not.
  void keep();

 private:
  const PictureTracer& pictures_;
  const EmitterTally& emitters_;
  StoredFilm& stored_;
  const TraceCounts before_;
  std::function<void()> keep_goal_;
};

}  // namespace sdlc::render
