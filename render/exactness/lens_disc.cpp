#include "render/exactness/lens_disc.hpp"

#include <algorithm>
#include <cmath>

namespace sdlc::render {

/// The bound that equals the distance at `point`, which is on the path. The plane through the
/// disc's nearest point, perpendicular to the line from there to `point`, separates the two: for
/// any unit vector n, no point of the disc has a larger n · q than radius · |n without its axial
/// part|. So a rounded n gives a bound that is less tight, but still a bound.
LensDisc::Bound LensDisc::bound_at(Vec3 point, Vec3 opening, Vec3 displacement) const noexcept {
  const double h = height(point);
  const Vec3 across = point - axis_ * h;
  const double rho = length(across);
  const Vec3 away = rho > radius_ ? axis_ * h + across * (1 - radius_ / rho) : axis_ * h;
  const double distance = length(away);
  if (!(distance > 0)) return {};
  const Vec3 n = away / distance;
  return {.at_opening = dot(n, opening) - radius_ * from_axis(n), .slope = dot(n, displacement)};
}

/// The distance is a convex function of the time. Its minimum is between a bound that falls and one
/// that rises, and not below their intersection. The distance there gives the next bound, and the
/// error shrinks to a quarter at least (Kelley's cutting planes in one dimension).
double LensDisc::nearest_of_path(Vec3 opening, Vec3 displacement) const noexcept {
  constexpr double kTolerance = 0x1p-40;
  constexpr int kMaxSteps = 64;
  const double rounding = 0x1p-48 * (length(opening) + length(displacement) + radius_);
  const auto bound_at_time = [&](double u) {
    return bound_at(opening + displacement * u, opening, displacement);
  };
  Bound falls = bound_at_time(0), rises = bound_at_time(1);
  double lowest = 0;
  if (falls.slope >= 0) {
    lowest = falls.at(0);
  } else if (rises.slope <= 0) {
    lowest = rises.at(1);
  } else {
    for (int i = 0; i < kMaxSteps; ++i) {
      const double u =
          std::clamp((falls.at_opening - rises.at_opening) / (rises.slope - falls.slope), 0.0, 1.0);
      lowest = std::fmin(falls.at(u), rises.at(u));
      const double there = nearest(opening + displacement * u);
      if (there - lowest <= kTolerance * there + rounding) break;
      const Bound next = bound_at_time(u);
      (next.slope < 0 ? falls : rises) = next;
    }
  }
  return std::fmax(0, lowest - rounding);
}

}  // namespace sdlc::render
