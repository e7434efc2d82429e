#pragma once

#include <cmath>

#include "render/math/vec3.hpp"

namespace sdlc::render {

/// The exponent e of v = m · 2^e with 1 ≤ m < 2, for finite positive `v`; 0 for 0.
inline int exponent_of(double v) noexcept { return v > 0 ? std::ilogb(v) : 0; }

/// `v` · 2^e, exact unless the result is subnormal or too large.
inline Vec3 scaled_by_power_of_two(Vec3 v, int e) noexcept {
  return {std::ldexp(v.x, e), std::ldexp(v.y, e), std::ldexp(v.z, e)};
}

/// The length of a finite vector, also if its squares overflow or underflow.
inline double moderate_length(Vec3 v) noexcept {
  // No square of a relevant component comes near the limits of double, and the result equals
  // length().
  constexpr double kMin = 0x1p-800, kMax = 0x1p800;
  const double squared = length_squared(v);
  if (squared >= kMin && squared < kMax) return std::sqrt(squared);
  const int e = exponent_of(max_abs(v));
  return std::ldexp(length(scaled_by_power_of_two(v, -e)), e);
}

/// `v` scaled by the power of two that brings its largest component into [1, 2), so that the square
/// of its length neither overflows nor underflows. Precondition: finite, not zero.
inline Vec3 with_moderate_length(Vec3 v) noexcept {
  return scaled_by_power_of_two(v, -exponent_of(max_abs(v)));
}

/// A vector in the direction from `a` to `b`, of any length; safe where b − a overflows. Zero if a
/// equals b.
inline Vec3 direction_between(Vec3 a, Vec3 b) noexcept {
  // Halving first keeps the difference of two numbers near 1.8e308 finite.
  const int e = exponent_of(std::fmax(max_abs(a), max_abs(b))) >= 1000 ? -2 : 0;
  const Vec3 d = scaled_by_power_of_two(b, e) - scaled_by_power_of_two(a, e);
  return d == Vec3{} ? d : with_moderate_length(d);
}

}  // namespace sdlc::render
