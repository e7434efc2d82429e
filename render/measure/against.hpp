#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "render/measure/measurement.hpp"

namespace sdlc::render {

enum class Verdict : std::uint8_t { NotDistinguished, Better, Worse };

/// A point that an earlier measurement of the same scene has too.
struct PointChange {
  Way way;
  int samples = 0;
  Measured error_before, error_after;
  Measured seconds_before, seconds_after;
  Verdict error = Verdict::NotDistinguished;  ///< at 95 % for all points together
};

/// What changed since an earlier measurement.
struct Comparison {
  std::string earlier;  ///< the version that made it
  std::vector<PointChange> points;
  /// Times now to those then, over all points; nothing where they cannot be held against each
  /// other.
  std::optional<Measured> time_ratio;
  Verdict time = Verdict::NotDistinguished;
  std::vector<std::string>
      notes;  ///< what differs beside: "another machine: times are not compared"
};

}  // namespace sdlc::render
