#pragma once

#include <cstdint>

namespace sdlc::render {

/// Statistics about samples, beside their sums. Sums of integers do not depend on their order.
struct TraceCounts {
  std::uint64_t rays = 0;
  std::uint64_t truncated_paths = 0;    ///< cut off by the depth limit, counted as black
  std::uint64_t nonfinite_samples = 0;  ///< counted as black

  TraceCounts& operator+=(const TraceCounts& other) noexcept {
    rays += other.rays;
    truncated_paths += other.truncated_paths;
    nonfinite_samples += other.nonfinite_samples;
    return *this;
  }
  friend bool operator==(const TraceCounts&, const TraceCounts&) = default;
};

}  // namespace sdlc::render
