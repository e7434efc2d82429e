#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "render/measure/measurement.hpp"

namespace sdlc::render {

enum class Verdict : std::uint8_t { NotDistinguished, Better, Worse };

/// "not distinguished", "better", "worse".
std::string_view name_of(Verdict verdict) noexcept;

/// A point that an earlier measurement of the same scene has too.
struct PointChange {
  Way way{};
  int samples = 0;
  Measured error_before, error_after;
  Measured seconds_before, seconds_after;
  Verdict error = Verdict::NotDistinguished;  ///< at 95 % for all points together
};

/// What changed since an earlier measurement.
struct Comparison {
  std::string earlier{};  ///< the version that made it
  std::vector<PointChange> points{};
  /// Times now to those then, over all points; nothing where they cannot be held against each
  /// other.
  std::optional<Measured> time_ratio{};
  Verdict time = Verdict::NotDistinguished;
  std::vector<std::string>
      notes;  ///< what differs beside: "another machine: times are not compared"
};

/// Holds the points that both have against each other. An error has changed where the difference is
/// beyond what the intervals and the spread from seed to seed make likely, at 5 % for all points
/// together (Bonferroni). Times where, over three points or more of 5 ms or longer, the interval of
/// their mean ratio lies beyond 1 and the 5 % by which one and the same machine drifts from day to
/// day. That interval is at least as long as that of one time of each measurement, however many
/// points there are: they share what the machine was like. `has_comparable_times`: they are of the
/// same machine and number of threads.
Comparison compare_measurements(const std::vector<Point>& now, const std::vector<Point>& before,
                                bool has_comparable_times);

}  // namespace sdlc::render
