#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "render/film/film.hpp"
#include "render/math/clock.hpp"
#include "render/session/error_goal.hpp"
#include "render/session/picture_denoiser.hpp"
#include "render/session/picture_tracer.hpp"
#include "render/session/render.hpp"
#include "render/shading/emitter_tally.hpp"

namespace sdlc::render {

/// Whether rare kinds of path may add more than half of the interval's upper end to the error of a
/// picture, an eighth in total. False if the error is not known anyway.
bool has_unseen_error(const RenderResult& result, const EmitterTally& emitters);

/// The error of the picture, unless rare kinds of path, or paths that were cut off, may hide more.
ErrorSoFar known_error(const RenderResult& result, const EmitterTally& emitters);

/// Whether rare kinds of path have hidden noise from the last passes (ErrorGoal::is_blind()), and
/// more than `samples` per pixel may show it. Then no goal is reached.
bool may_see_more(const ErrorGoal& goal, const EmitterTally& emitters, std::uint64_t samples);

/// A render in passes over the whole picture, until a goal or the number of samples is reached.
class GoalRender {
 public:
  /// Keeps references to all arguments. RenderSettings::seconds counts from `start`.
  GoalRender(PictureTracer& tracer, const RenderSettings& settings, const EmitterTally& emitters,
             Clock::time_point start, RenderMonitor& monitor, Film& film, RenderResult& result);

  /// Goes on with a render that had these targets() and passes().
  void resume(std::vector<std::uint32_t> targets, std::vector<GoalPass> passes);
  /// Goals are those of the denoised picture. Keeps a reference.
  void denoise_with(const PictureDenoiser& denoiser) { denoiser_ = &denoiser; }
  void run();
  /// The samples of each pixel, as planned by an adaptive render: a cancelled pass has not reached
  /// all of them. Empty before the first such pass.
  const std::vector<std::uint32_t>& targets() const noexcept { return targets_; }
  std::vector<GoalPass> passes() const { return goal_ ? goal_->passes() : std::vector<GoalPass>(); }

 private:
  /// Brings the pixels to these samples, or all of them to the only element. Returns false if it
  /// was the last pass because of the time limit or cancellation.
  bool pass(std::span<const std::uint32_t> samples);
  void run_uniform();
  void run_adaptive();
  /// Begins with these samples of each pixel, of which there may be more already.
  void run_adaptive(std::vector<std::uint32_t> samples);
  std::vector<std::uint32_t> samples_of_film() const;
  bool is_late() const;
  void report_progress(double share);
  /// Once, after a pass: sets the deadline so much earlier as estimating the error and the work of
  /// the caller take.
  void reserve_time_to_finish();
  /// Updates the picture, its error estimate and the numbers of samples.
  void estimate();
  /// The part of it without denoising and goals.
  void estimate_plain();
  ErrorSoFar error_so_far();

  PictureTracer& tracer_;
  const RenderSettings& settings_;
  const EmitterTally& emitters_;
  RenderMonitor& monitor_;
  RenderResult& result_;
  std::optional<Clock::time_point> deadline_;
  Clock::time_point start_;
  Film& film_;
  std::optional<ErrorGoal> goal_;
  std::optional<ErrorEstimate> unsettled_;  // RenderResult::error before ErrorGoal::settled()
  const PictureDenoiser* denoiser_ = nullptr;
  std::vector<PixelSpread> spreads_;
  std::vector<std::uint32_t> targets_;
  bool is_first_pass_ = true;
  bool is_time_reserved_ = false;
};

}  // namespace sdlc::render
