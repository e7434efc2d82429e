#pragma once

namespace sdlc::render {

struct SinCos {
  double sin, cos;
};

/// Sine and cosine of `v` turns, 0 ≤ v < 1, to about one unit in the last place. Uses only + − × on
/// doubles, so results are bit-identical on every machine, which the C library does not guarantee.
inline SinCos sincos_turns(double v) noexcept {
  constexpr double kHalfPi = 1.57079632679489661923;
  const int quadrant = static_cast<int>(v * 4 + 0.5);  // nearest quarter turn, 0 … 4
  const double x = (v * 4 - quadrant) * kHalfPi;       // |x| ≤ π/4; the difference is exact
  const double y = x * x;
  // Taylor series; at π/4 the first omitted terms are below 5e-17.
  const double s =
      x * (1 + y * (-1.0 / 6 +
                    y * (1.0 / 120 +
                         y * (-1.0 / 5040 +
                              y * (1.0 / 362880 +
                                   y * (-1.0 / 39916800 +
                                        y * (1.0 / 6227020800 + y * (-1.0 / 1307674368000))))))));
  const double c =
      1 + y * (-1.0 / 2 +
               y * (1.0 / 24 +
                    y * (-1.0 / 720 +
                         y * (1.0 / 40320 +
                              y * (-1.0 / 3628800 +
                                   y * (1.0 / 479001600 +
                                        y * (-1.0 / 87178291200 + y * (1.0 / 20922789888000))))))));
  switch (quadrant & 3) {
    case 0: return {s, c};
    case 1: return {c, -s};
    case 2: return {-s, -c};
    default: return {-c, s};
  }
}

}  // namespace sdlc::render
