#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "render/measure/measurement.hpp"

namespace sdlc::render {

/// How much the time of one and the same render differs on this machine: the standard deviation of
/// its logarithm, from renders that were made again and again over the whole measurement.
class NoiseOfTime {
 public:
  /// `timings`: of each render the seconds of its repeats; those of one repeat say nothing.
  explicit NoiseOfTime(std::span<const std::vector<double>> timings);

  double sigma() const noexcept { return sigma_; }

  /// The median of some repeats, and the interval of the time that many repeats would have as
  /// theirs.
  Measured typical(std::vector<double> timings) const;
  /// The interval of the next time, of a render that is expected to take `seconds` by `repeats`.
  Measured next(double seconds, std::size_t repeats) const;

 private:
  Measured around(double seconds, double standard_errors) const;

  double sigma_ = 0;
  double degrees_ = 0;
};

}  // namespace sdlc::render
