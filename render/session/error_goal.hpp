#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "render/film/goal_pass.hpp"
#include "render/session/error_estimate.hpp"

namespace sdlc::render {

/// The error falls as a power of the number of samples. min_error() is the smallest error to hope
/// for with `more_samples` times as many samples (Sobol' points, plain edges); usual_growth() is
/// the usual factor in samples for multiplying the error by `part`.
double min_error(double error, double more_samples) noexcept;
double usual_growth(double part) noexcept;

/// Decides after each pass over a picture how many samples to take next, until the error is known
/// to be small enough.
class ErrorGoal {
 public:
  /// The goal is reached when the upper end of the confidence interval of the relative error is at
  /// most `error`.
  ErrorGoal(double error, std::uint64_t max_samples) : error_(error), max_samples_(max_samples) {}

  /// The passes so far; restore() goes on after them.
  const std::vector<GoalPass>& passes() const noexcept { return passes_; }
  void restore(std::vector<GoalPass> passes) { passes_ = std::move(passes); }

  /// The minimum for any goal: with fewer samples all replicates may miss the same highlight.
  std::uint64_t first_samples() const noexcept;
  /// The samples per pixel to reach with a pass after `samples`: an eighth more. The steps do not
  /// depend on the goal, so that a render that is resumed with a lower one goes on like a new one.
  std::uint64_t samples_after(std::uint64_t samples) const noexcept;

  /// The estimate to go by after a pass. Where a few pixels have most of the error, a single
  /// estimate is too small by chance now and then, and the first such pass would end the render.
  /// There the interval also contains the one whose ends, squared, are averages over this pass and
  /// the earlier ones with at least a quarter of its samples, as they would be with its number of
  /// samples. Such pixels show in wide intervals: in one of these passes the square of the upper
  /// end is more than twice that of the error.
  ErrorEstimate settled(std::uint64_t samples, const ErrorEstimate& estimate) const;

  bool is_reached(const ErrorEstimate& estimate) const noexcept {
    return estimate.interval.to <= error_;
  }

  /// Records a whole pass, with the estimate before it was settled. `is_blind`: rare kinds of path
  /// may hide the error.
  void record(std::uint64_t samples, const ErrorEstimate& estimate, bool is_blind);
  /// Whether the last pass was blind, or one before it with as many samples up to a factor of 2:
  /// with a look after each pass, one of them would miss it by chance.
  bool is_blind() const noexcept;

 private:
  double error_;
  std::uint64_t max_samples_;
  std::vector<GoalPass> passes_;
};

}  // namespace sdlc::render
