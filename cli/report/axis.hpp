#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace sdlc::cli {

/// A line of the grid.
struct Tick {
  double value = 0;
  bool is_labelled = false;
};

/// A logarithmic axis. What is not above 0 lies at its beginning.
class LogAxis {
 public:
  /// A little more than the values that are above 0, and up to half as much again at least.
  static LogAxis covering(std::span<const double> values);

  double from() const noexcept { return from_; }
  double to() const noexcept { return to_; }

  /// Where the value lies: 0 at the beginning, 1 at the end, not beyond either.
  double share(double value) const noexcept;

  /// Ascending. Labels at 1, 2, 5 times powers of ten; where those are too many, at 1, 3 times, at
  /// powers of ten or at some of them; where they are less than three, at even steps.
  std::vector<Tick> ticks(std::size_t most_labels) const;

 private:
  LogAxis(double from, double to) : from_(from), to_(to) {}

  double from_, to_;
};

}  // namespace sdlc::cli
