#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "render/film/film.hpp"
#include "render/light/emitter_tally.hpp"
#include "render/tiles/picture_tracer.hpp"
#include "render/tiles/render.hpp"

namespace sdlc::render {

/// Whether kinds of path that were found too rarely may add more than half of the upper end of its
/// interval to the error of a picture, an eighth in all. False where the error is not known anyway.
bool has_unseen_error(const RenderResult& result, const EmitterTally& emitters);

/// A render with a goal: passes over the whole picture until one of them is reached.
class GoalRender {
 public:
  using Clock = std::chrono::steady_clock;

  /// All are borrowed. `start`: when the time that RenderSettings::seconds counts began.
  GoalRender(PictureTracer& tracer, const RenderSettings& settings, const EmitterTally& emitters,
             Clock::time_point start, RenderMonitor& monitor, RenderResult& result);

  void run();

 private:
  using Target = std::function<std::uint64_t(std::size_t pixel)>;

  /// One pass; false when it was the last, as time ran out or somebody cancels.
  bool pass(std::uint64_t most, const Target& target);
  void run_uniform();
  void run_adaptive();
  bool is_late() const;
  void tell_share(double share);
  /// Takes over the picture and what is known of its error.
  void estimate();

  PictureTracer& tracer_;
  const RenderSettings& settings_;
  const EmitterTally& emitters_;
  RenderMonitor& monitor_;
  RenderResult& result_;
  std::optional<Clock::time_point> deadline_;
  Clock::time_point start_;
  Film film_;
  std::vector<PixelSpread> spreads_;
  bool is_first_pass_ = true;
};

}  // namespace sdlc::render
