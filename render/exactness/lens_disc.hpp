#pragma once

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
  /// `opening` by `displacement`; at most 0 if they meet. Of a moving sphere it is a lower bound,
  /// which rounding cannot exceed, and exact to 2^-40: no sphere passes the lens unseen.
  double clearance(Vec3 opening, Vec3 displacement, double radius) const noexcept {
    const bool is_moving = displacement != Vec3{};
    const double outside = is_moving ? nearest_of_path(opening, displacement) : nearest(opening);
    // A convex function of the time is largest at an end.
    const double reach = std::fmax(farthest(opening), farthest(opening + displacement));
    return std::fmax(outside - radius, radius - reach);
  }

 private:
  double height(Vec3 point) const noexcept { return dot(point, axis_); }
  double from_axis(Vec3 point) const noexcept { return length(point - axis_ * height(point)); }

  /// A lower bound of the distance from the disc to the points of a path, linear in the time u.
  struct Bound {
    double at_opening = 0, slope = 0;
    double at(double u) const noexcept { return at_opening + slope * u; }
  };
  Bound bound_at(Vec3 point, Vec3 opening, Vec3 displacement) const noexcept;
  double nearest_of_path(Vec3 opening, Vec3 displacement) const noexcept;

  Vec3 axis_{0, 0, -1};
  double radius_ = 0;
};

}  // namespace sdlc::render
