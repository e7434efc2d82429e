#pragma once

#include <algorithm>
#include <cmath>

#include "render/math/vec3.hpp"

namespace sdlc::render {

/// The disc of a thin lens around the origin, and its distances from spheres. All lengths are in
/// one unit, of moderate size. Radius 0: a pinhole.
class LensDisc {
 public:
  LensDisc() = default;
  /// `axis`: the view direction, of length 1.
  LensDisc(Vec3 axis, double radius) : axis_(axis), radius_(radius) {}

  double radius() const noexcept { return radius_; }

  /// The distance of a point from the nearest point of the disc.
  double nearest(Vec3 point) const noexcept {
    return std::hypot(height(point), std::fmax(0, from_axis(point) - radius_));
  }
  /// The same from the farthest point of the disc.
  double farthest(Vec3 point) const noexcept {
    return std::hypot(height(point), from_axis(point) + radius_);
  }

  /// The smallest distance between the disc and the surface of a sphere while its centre moves from
  /// `opening` by `displacement`; at most 0 if they meet. Both distances above are convex functions
  /// of the time: the farthest is largest at an end, and the nearest has one minimum, which is
  /// found by golden section search.
  double clearance(Vec3 opening, Vec3 displacement, double radius) const noexcept {
    const Vec3 closing = opening + displacement;
    const double outside =
        displacement == Vec3{} ? nearest(opening) : nearest_of_path(opening, displacement);
    return std::fmax(outside - radius, radius - std::fmax(farthest(opening), farthest(closing)));
  }

 private:
  double height(Vec3 point) const noexcept { return dot(point, axis_); }
  double from_axis(Vec3 point) const noexcept { return length(point - axis_ * height(point)); }

  double nearest_of_path(Vec3 opening, Vec3 displacement) const noexcept {
    constexpr double kShare = 0.6180339887498949;
    constexpr int kSteps = 50;  // to 4e-11 of the path
    const auto at = [&](double u) { return nearest(opening + displacement * u); };
    double from = 0, to = 1, min = std::fmin(at(0), at(1));
    for (int i = 0; i < kSteps; ++i) {
      const double low = to - kShare * (to - from), high = from + kShare * (to - from);
      const double at_low = at(low), at_high = at(high);
      min = std::min({min, at_low, at_high});
      (at_low < at_high ? to : from) = at_low < at_high ? high : low;
    }
    return min;
  }

  Vec3 axis_{0, 0, -1};
  double radius_ = 0;
};

}  // namespace sdlc::render
