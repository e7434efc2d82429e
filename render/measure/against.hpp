#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "render/measure/measurement.hpp"

namespace sdlc::render {

enum class Verdict : std::uint8_t { NotDistinguished, Better, Worse };

template <>
inline constexpr auto kWords<Verdict> = std::to_array<std::string_view>({"not distinguished",
                                                                         "better", "worse"});

/// A point that is also in an earlier measurement of the same scene.
struct PointChange {
  Configuration configuration{};
  int samples = 0;
  Measured relative_error_before{}, relative_error{}, seconds_before{}, seconds{};
  Verdict error = Verdict::NotDistinguished;  ///< at 95 % for all points together
};

/// Changes since an earlier measurement.
struct Comparison {
  std::string version{};  ///< of the program that made the earlier one
  std::vector<PointChange> points{};
  /// Mean ratio of the times, now to then, over all points; nullopt if they are not comparable.
  std::optional<Measured> time_ratio{};
  Verdict time = Verdict::NotDistinguished;
  int worse_errors = 0;  ///< number of points
  std::vector<std::string>
      notes{};  ///< other differences: "another machine: times are not compared"
};

/// Compares the points that both measurements have. An error has changed if the difference exceeds
/// what the confidence intervals and the spread over seeds explain, at 5 % for all points together
/// (Bonferroni). The times have changed if the confidence interval of their mean ratio, over at
/// least three points of at least 5 ms, excludes 1 by more than the 5 % by which one machine drifts
/// from day to day. That interval is never shorter than that of a single time per measurement,
/// because all points share the state of the machine. `has_comparable_times`: both were made on the
/// same machine with the same number of threads.
Comparison compare_measurements(const std::vector<Point>& now, const std::vector<Point>& before,
                                bool has_comparable_times);

}  // namespace sdlc::render
