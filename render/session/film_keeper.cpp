#include "render/session/film_keeper.hpp"

#include <utility>

namespace sdlc::render {

FilmKeeper::FilmKeeper(PictureTracer& pictures, const EmitterTally& emitters,
                       const RenderMonitor& monitor, StoredFilm& stored,
                       std::function<void()> keep_goal)
    : pictures_(pictures),
      emitters_(emitters),
      stored_(stored),
      before_(stored.statistics),
      keep_goal_(std::move(keep_goal)) {
  pictures.finish_tiles();
  if (!monitor.on_checkpoint) return;
  pictures.pause_every(monitor.checkpoint_seconds, [this, &monitor] {
    keep();
    monitor.on_checkpoint(stored_);
  });
}

void FilmKeeper::keep() {
  stored_.statistics = before_;
  stored_.statistics += pictures_.counts();
  if (!pictures_.has_dropped()) stored_.emitters = emitters_.counts();
  if (keep_goal_) keep_goal_();
}

}  // namespace sdlc::render
