#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace sdlc::cli {

/// A logarithmic axis over at least a decade.
class LogAxis {
 public:
  /// Covers the positive, finite values with a margin.
  explicit LogAxis(std::span<const double> values);

  /// The position of the value: 0 at the beginning, 1 at the end, clamped; 0 if it is not positive.
  double share(double value) const noexcept;

  /// Ascending: 1, 2 and 5 times powers of ten, or as many powers of ten as `max_count` allows.
  std::vector<double> ticks(std::size_t max_count) const;

 private:
  double from_, to_;  // decimal logarithms, because the ratio of two doubles may overflow
};

}  // namespace sdlc::cli
