#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "render/measure/measurement.hpp"

namespace sdlc::render {

/// The mean of a few values with its 95 % interval, by Student's t distribution.
Measured mean_of(std::span<const double> values);

/// The noise of render times on this machine: the standard deviation of the logarithm of the time,
/// from renders repeated over the whole measurement.
class NoiseOfTime {
 public:
  /// `timings`: per render, the seconds of its repetitions; renders without repetition are ignored.
  explicit NoiseOfTime(std::span<const std::vector<double>> timings);

  double sigma() const noexcept { return sigma_; }

  /// The median of some repetitions, with the confidence interval of the true median.
  Measured typical(std::vector<double> timings) const;
  /// The prediction interval of the next time, for a render that took `seconds` in `repeats`
  /// repetitions.
  Measured next(double seconds, std::size_t repeats) const;

 private:
  Measured around(double seconds, double standard_errors) const;

  double sigma_ = 0;
  double degrees_ = 0;
};

}  // namespace sdlc::render
