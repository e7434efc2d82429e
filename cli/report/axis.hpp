#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace sdlc::cli {

/// A grid line.
struct Tick {
  double value = 0;
  bool is_labelled = false;
};

/// A logarithmic axis. Values that are not positive are at its beginning.
class LogAxis {
 public:
  /// Covers the positive values with a margin; the end is at least half as much again as the
  /// beginning.
  static LogAxis covering(std::span<const double> values);

  double from() const noexcept { return from_; }
  double to() const noexcept { return to_; }

  /// The position of the value: 0 at the beginning, 1 at the end, clamped.
  double share(double value) const noexcept;

  /// Ascending. Labels are at 1, 2, 5 times powers of ten; if those are too many, at 1, 3 times, at
  /// powers of ten or at some of them; if there are fewer than three, at even steps.
  std::vector<Tick> ticks(std::size_t max_labels) const;

 private:
  LogAxis(double from, double to) : from_(from), to_(to) {}

  double from_, to_;
};

}  // namespace sdlc::cli
