#pragma once

namespace sdlc::render {

/// Two ends of a range along one axis: shutter times, distances along a ray. The ends may be equal
/// or in either order if the user of the interval says so.
struct Interval {
  double from = 0, to = 0;

  friend constexpr bool operator==(const Interval&, const Interval&) = default;
};

constexpr double lerp(Interval interval, double u) noexcept {
  return interval.from + (interval.to - interval.from) * u;
}

}  // namespace sdlc::render
