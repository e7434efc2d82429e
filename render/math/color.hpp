#pragma once

#include <cmath>

namespace sdlc::render {

/// A colour or a radiance in linear RGB with the sRGB primaries; 1 is white, larger values are
/// brighter than white. One component of the JSON config format is 255 times this.
struct LinearRgb {
  double r = 0, g = 0, b = 0;

  constexpr LinearRgb() = default;
  constexpr explicit LinearRgb(double grey) noexcept : r(grey), g(grey), b(grey) {}
  constexpr LinearRgb(double red, double green, double blue) noexcept : r(red), g(green), b(blue) {}

  friend constexpr bool operator==(const LinearRgb&, const LinearRgb&) = default;
};

constexpr LinearRgb operator+(LinearRgb a, LinearRgb b) noexcept {
  return {a.r + b.r, a.g + b.g, a.b + b.b};
}
constexpr LinearRgb operator-(LinearRgb a, LinearRgb b) noexcept {
  return {a.r - b.r, a.g - b.g, a.b - b.b};
}
constexpr LinearRgb operator*(LinearRgb a, LinearRgb b) noexcept {
  return {a.r * b.r, a.g * b.g, a.b * b.b};
}
constexpr LinearRgb operator*(LinearRgb a, double s) noexcept {
  return {a.r * s, a.g * s, a.b * s};
}
constexpr LinearRgb operator*(double s, LinearRgb a) noexcept { return a * s; }
constexpr LinearRgb operator/(LinearRgb a, double s) noexcept {
  return {a.r / s, a.g / s, a.b / s};
}
constexpr LinearRgb& operator+=(LinearRgb& a, LinearRgb b) noexcept { return a = a + b; }
constexpr LinearRgb& operator*=(LinearRgb& a, LinearRgb b) noexcept { return a = a * b; }

constexpr bool is_black(LinearRgb c) noexcept { return c.r == 0 && c.g == 0 && c.b == 0; }
inline bool is_finite(LinearRgb c) noexcept {
  return std::isfinite(c.r) && std::isfinite(c.g) && std::isfinite(c.b);
}

}  // namespace sdlc::render
