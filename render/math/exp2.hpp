#pragma once

#include <cmath>

namespace sdlc::render {

/// 2^v to about one unit in the last place, exact for whole v; infinite above the range of double,
/// 0 below and for NaN. Like sincos_turns() it uses only + − × on doubles, so results are
/// bit-identical on every machine.
inline double exp2_reproducible(double v) noexcept {
  constexpr double kLn2 = 0.69314718055994530942;
  constexpr double kBeyond = 1100;
  const double x = std::fmin(std::fmax(v, -kBeyond), kBeyond);
  const double whole = std::nearbyint(x);
  const double y = (x - whole) * kLn2;  // |y| ≤ 0.35
  // Taylor series in Horner's form; the first omitted term is below 5e-18.
  double power = 1;
  for (int n = 13; n > 0; --n) power = 1 + y * power * (1.0 / n);
  return std::ldexp(power, static_cast<int>(whole));
}

}  // namespace sdlc::render
