#pragma once

#include <cstdint>
#include <optional>
#include <vector>

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

  /// The minimum for any goal: with fewer samples all replicates may miss the same highlight.
  std::uint64_t first_samples() const noexcept;

  /// The estimate to go by after a pass. Where a few pixels have most of the error, a single
  /// estimate is too small by chance now and then, and the first such pass would end the render.
  /// There the interval also contains the one whose ends, squared, are averages over this pass and
  /// the earlier ones with at least a quarter of its samples, as they would be with its number of
  /// samples. Such pixels show in wide intervals: in one of these passes the square of the upper
  /// end is more than twice that of the error.
  ErrorEstimate settled(std::uint64_t samples, const ErrorEstimate& estimate);

  /// Returns the samples per pixel to reach with the next pass, given the samples so far and the
  /// estimate from them; nullopt once the goal or the maximum is reached. A pass adds at most a
  /// quarter, and less where the slope of the error so far says that less is enough.
  std::optional<std::uint64_t> next_samples(std::uint64_t samples, const ErrorEstimate& estimate);

  bool is_reached() const noexcept { return is_reached_; }

 private:
  struct Pass {
    std::uint64_t samples;
    double from, to, estimate;  // squares
  };

  double error_;
  std::uint64_t max_samples_;
  std::vector<Pass> passes_;
  bool is_reached_ = false;
  // The exponent with which the error falls. The initial value lies between independent samples
  // (-0.5) and the best case of Sobol' points.
  double slope_ = -0.6;
  std::uint64_t earlier_samples_ = 0;
  double earlier_error_ = 0;
};

}  // namespace sdlc::render
