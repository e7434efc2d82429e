#include "lang/math/easing.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "lang/math/elementary.hpp"

namespace sdlc::lang {
namespace {

/// 1024^t from 0 to 1. (Penner's 1024^(t - 1) jumps from 0 to 0.001 at the beginning.)
double exponential(double t) noexcept { return (power(1024, t) - 1) / 1023; }

/// How far a ball is below the height 1 from which it falls, for t from 0 to 1: it reaches the
/// ground at 4, 8 and 10 parts of 11, and rests there at the end. It rises to 1/4, 1/16 and 1/64.
double bounced(double t) noexcept {
  struct Arc {
    double end, middle, rise;
  };
  static constexpr std::array<Arc, 4> kArcs{{{4 / 11.0, 0, 0},
                                             {8 / 11.0, 6 / 11.0, 1 / 4.0},
                                             {10 / 11.0, 9 / 11.0, 1 / 16.0},
                                             {1, 10.5 / 11.0, 1 / 64.0}}};
  const auto arc = std::ranges::find_if(kArcs, [&](const Arc& a) { return t < a.end; });
  if (arc == kArcs.end()) return 1;
  const double x = t - arc->middle;
  const double fall = 121 / 16.0 * x * x;
  return arc == kArcs.begin() ? fall : fall + (1 - arc->rise);
}

/// For t between 0 and 1.
double curve_at(EaseCurve curve, double t) noexcept {
  constexpr double kOvershoot = 1.70158;  // Penner's: the lowest point is -0.1
  switch (curve) {
    case EaseCurve::Sine: return 1 - cos_degrees(90 * t);
    case EaseCurve::Quad: return t * t;
    case EaseCurve::Cubic: return t * t * t;
    case EaseCurve::Quart: return (t * t) * (t * t);
    case EaseCurve::Expo: return exponential(t);
    case EaseCurve::Circ: return 1 - std::sqrt((1 - t) * (1 + t));
    case EaseCurve::Back: return t * t * (t - kOvershoot * (1 - t));
    case EaseCurve::Elastic: return exponential(t) * cos_degrees(1200 * (1 - t));
    case EaseCurve::Bounce: return 1 - bounced(1 - t);
  }
  return t;
}

}  // namespace

EaseCurve find_ease_curve(std::string_view name) noexcept {
  return static_cast<EaseCurve>(std::ranges::find(kEaseCurveNames, name) - kEaseCurveNames.begin());
}

double ease_in(EaseCurve curve, double t) noexcept {
  return t <= 0 ? 0 : t >= 1 ? 1 : curve_at(curve, t);
}

double ease_out(EaseCurve curve, double t) noexcept { return 1 - ease_in(curve, 1 - t); }

double ease_in_out(EaseCurve curve, double t) noexcept {
  return t < 0.5 ? ease_in(curve, 2 * t) / 2 : 1 - ease_in(curve, 2 - 2 * t) / 2;
}

}  // namespace sdlc::lang
