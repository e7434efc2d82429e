#pragma once

#include <optional>

/// Elementary functions computed with + - * / and square roots only, so that their bits are the
/// same on every machine and with every C library. All arguments are finite.
///
/// A result is computed to about 96 bits and then rounded: it is the nearest double unless the true
/// value lies within 2^-40 of an ulp from the midpoint of two. Exact results are exact. `nullopt`:
/// there is no real result; infinity: it is too large for a double.
namespace sdlc::lang {

double exp(double x) noexcept;

/// The natural logarithm; nullopt for x <= 0.
std::optional<double> log(double x) noexcept;

/// x^y for x > 0. Subnormal results are rounded twice: within 0.75 ulp.
double power(double x, double y) noexcept;

/// x^y of the language: x^2 and x^3 are products, 1/x is a quotient, 0^0 is 1.
/// nullopt for negative powers of zero, and for x < 0 where y is not a whole number.
std::optional<double> raise(double x, double y) noexcept;

/// Angles are in degrees and reduced exactly: sin 180 is 0, cos 60 is 1/2.
double sin_degrees(double x) noexcept;
double cos_degrees(double x) noexcept;

/// nullopt at odd multiples of 90.
std::optional<double> tan_degrees(double x) noexcept;

/// Between -90 and 90; nullopt for |x| > 1.
std::optional<double> asin_degrees(double x) noexcept;

/// Between 0 and 180; nullopt for |x| > 1.
std::optional<double> acos_degrees(double x) noexcept;

/// Between -90 and 90.
double atan_degrees(double x) noexcept;

/// The angle from the x axis to (x, y), -180 to 180; nullopt for (0, 0). The sign of a zero is
/// ignored: (-1, 0) and (-1, -0) are both at 180.
std::optional<double> atan2_degrees(double y, double x) noexcept;

double radians_from_degrees(double degrees) noexcept;
double degrees_from_radians(double radians) noexcept;

/// The nearest whole number; halves are rounded away from zero.
double round_half_away(double x) noexcept;

/// a - b floor(a / b): between 0 and b. Exact, unless the remainder is no double and is rounded:
/// that of -1e-20 by 1 is 1. nullopt for b = 0.
std::optional<double> modulo(double a, double b) noexcept;

}  // namespace sdlc::lang
