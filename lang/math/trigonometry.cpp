#include <array>
#include <cmath>

#include "lang/math/double_double.hpp"
#include "lang/math/elementary.hpp"
#include "lang/math/series.hpp"

namespace sdlc::lang {
namespace {

constexpr DoubleDouble kRadiansPerDegree{0x1.1df46a2529d39p-6, 0x1.5c1d8becdd291p-62};
constexpr DoubleDouble kDegreesPerRadian{0x1.ca5dc1a63c1f8p+5, -0x1.1e7ab456405f9p-49};

/// x * factor for every finite x, rounded once.
double multiplied(double x, DoubleDouble factor) noexcept {
  if (x == 0) return x;
  int exponent = 0;
  const double fraction = std::frexp(x, &exponent);
  return scaled(DoubleDouble{fraction, 0} * factor, exponent);
}

/// Below this, sine and tangent of an angle x in radians are x: the difference, at most x^3 / 3, is
/// far below half an ulp. The series would compute with subnormal numbers.
constexpr double kTiny = 0x1p-500;

/// An angle as `quarters` right angles (0 ... 3) and the rest, at most half a right angle.
struct ReducedAngle {
  int quarters = 0;
  double degrees = 0;
};

/// Exact: so are the remainder by 360 and the difference of numbers within a factor of two of each
/// other (Sterbenz lemma).
ReducedAngle reduced(double degrees) noexcept {
  const double rest = std::fmod(degrees, 360.0);
  const double quarters = std::floor(rest / 90 + 0.5);  // -4 ... 4
  return {static_cast<int>(quarters) & 3, rest - quarters * 90};
}

struct SinCos {
  DoubleDouble sin, cos;
};

/// For |degrees| at most 45, or one ulp more.
SinCos sin_cos(double degrees) noexcept {
  const DoubleDouble x = DoubleDouble{degrees, 0} * kRadiansPerDegree;
  return {x * alternating_factorial_series(x, 1), alternating_factorial_series(x, 0)};
}

/// arctan t for |t| at most 1/16: the next term is below 2^-113.
constexpr DoubleDouble arctangent_of_small(DoubleDouble t) noexcept {
  return t * odd_reciprocal_series(-(t * t), 14);
}

/// arctan(k / 16) for k = 0 ... 16, each from the one before:
/// arctan a - arctan b = arctan((a - b) / (1 + a b)).
constexpr auto kArctangents = [] {
  std::array<DoubleDouble, 17> table;
  for (int k = 1; k <= 16; ++k) {
    const DoubleDouble step = DoubleDouble{16, 0} / DoubleDouble{256.0 + k * (k - 1), 0};
    table[k] = table[k - 1] + arctangent_of_small(step);
  }
  return table;
}();

/// arctan(y / x) in degrees for 0 <= y <= x, in the first half of the first quadrant.
DoubleDouble angle_in_octant(DoubleDouble y, DoubleDouble x) noexcept {
  const int nearest = static_cast<int>(std::floor(y.hi / x.hi * 16 + 0.5));
  const DoubleDouble tangent{nearest / 16.0, 0};
  const DoubleDouble rest = (y - x * tangent) / (x + y * tangent);
  return (kArctangents[nearest] + arctangent_of_small(rest)) * kDegreesPerRadian;
}

/// The angle of (x, y), 0 ... 180. Precondition: y >= 0, not both 0, the larger near 1.
double angle_of(DoubleDouble y, DoubleDouble x) noexcept {
  const DoubleDouble width = x.hi < 0 ? -x : x;
  const DoubleDouble in_quadrant =
      width.hi < y.hi ? DoubleDouble{90, 0} - angle_in_octant(width, y) : angle_in_octant(y, width);
  return (x.hi < 0 ? DoubleDouble{180, 0} - in_quadrant : in_quadrant).hi;
}

/// sqrt(1 - x^2)
DoubleDouble cathetus(double x) noexcept { return sqrt(two_sum(1, -x) * two_sum(1, x)); }

}  // namespace

double radians_from_degrees(double degrees) noexcept {
  return multiplied(degrees, kRadiansPerDegree);
}

double degrees_from_radians(double radians) noexcept {
  return multiplied(radians, kDegreesPerRadian);
}

double sin_degrees(double x) noexcept {
  if (std::fabs(x) < kTiny) return radians_from_degrees(x);
  const ReducedAngle angle = reduced(x);
  const SinCos value = sin_cos(angle.degrees);
  const double magnitude = angle.quarters % 2 == 0 ? value.sin.hi : value.cos.hi;
  return angle.quarters < 2 ? magnitude : -magnitude;
}

double cos_degrees(double x) noexcept {
  if (x == 0) return 1;  // frequent: groups without a rotation
  const ReducedAngle angle = reduced(x);
  const SinCos value = sin_cos(angle.degrees);
  const double magnitude = angle.quarters % 2 == 0 ? value.cos.hi : value.sin.hi;
  return angle.quarters == 0 || angle.quarters == 3 ? magnitude : -magnitude;
}

std::optional<double> tan_degrees(double x) noexcept {
  if (std::fabs(x) < kTiny) return radians_from_degrees(x);
  const ReducedAngle angle = reduced(x);
  const SinCos value = sin_cos(angle.degrees);
  if (angle.quarters % 2 == 0) return (value.sin / value.cos).hi;
  if (angle.degrees == 0) return std::nullopt;
  return (-value.cos / value.sin).hi;
}

std::optional<double> asin_degrees(double x) noexcept {
  if (std::fabs(x) > 1) return std::nullopt;
  if (std::fabs(x) < kTiny) return degrees_from_radians(x);
  return std::copysign(angle_of(DoubleDouble{std::fabs(x), 0}, cathetus(x)), x);
}

std::optional<double> acos_degrees(double x) noexcept {
  if (std::fabs(x) > 1) return std::nullopt;
  return angle_of(cathetus(x), DoubleDouble{x, 0});
}

double atan_degrees(double x) noexcept { return *atan2_degrees(x, 1); }

std::optional<double> atan2_degrees(double y, double x) noexcept {
  if (y == 0 && x == 0) return std::nullopt;
  int y_exponent = 0, x_exponent = 0;
  const double y_fraction = std::frexp(std::fabs(y), &y_exponent);
  const double x_fraction = std::frexp(x, &x_exponent);
  // The arctangent of a tiny quotient is the quotient, which may be subnormal.
  if (x > 0 && y != 0 && y_exponent < x_exponent - 500) {
    const DoubleDouble quotient = DoubleDouble{y_fraction, 0} / DoubleDouble{x_fraction, 0};
    return std::copysign(scaled(quotient * kDegreesPerRadian, y_exponent - x_exponent), y);
  }
  // If the smaller one underflows at the scale of the larger, it does not affect the angle.
  const int larger = std::fabs(x) < std::fabs(y) ? y_exponent : x_exponent;
  const double angle = angle_of(DoubleDouble{std::ldexp(y_fraction, y_exponent - larger), 0},
                                DoubleDouble{std::ldexp(x_fraction, x_exponent - larger), 0});
  return y < 0 ? -angle : angle;
}

}  // namespace sdlc::lang
