#include "render/compare/color_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <numbers>
#include <vector>

namespace sdlc::render {
namespace {

/// A colour in Oklab (Björn Ottosson, "A perceptual color space for image processing", 2020), where
/// the distance of two colours is about how different they look.
struct Oklab {
  double l, a, b;
};

constexpr Oklab operator+(Oklab p, Oklab q) noexcept { return {p.l + q.l, p.a + q.a, p.b + q.b}; }
constexpr Oklab operator*(double s, Oklab p) noexcept { return {s * p.l, s * p.a, s * p.b}; }

double distance(Oklab p, Oklab q) noexcept { return std::hypot(p.l - q.l, p.a - q.a, p.b - q.b); }

LinearRgb to_linear(Oklab c) noexcept {
  const auto cube = [](double v) { return v * v * v; };
  const double l = cube(c.l + 0.3963377774 * c.a + 0.2158037573 * c.b);
  const double m = cube(c.l - 0.1055613458 * c.a - 0.0638541728 * c.b);
  const double s = cube(c.l - 0.0894841775 * c.a - 1.2914855480 * c.b);
  return {4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
          -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
          -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s};
}

/// A colour as people name it: lightness, chroma, and hue in degrees.
struct Oklch {
  double l, c, h;
};

/// Control points of the colour map. Each is as colourful as a display allows, with some margin.
constexpr std::array kControlPoints{
    Oklch{0.12, 0.020, 270},  // nearly black
    Oklch{0.27, 0.130, 276},  // blue
    Oklch{0.41, 0.180, 315},  // violet
    Oklch{0.55, 0.210, 358},  // magenta
    Oklch{0.67, 0.190, 30},   // red
    Oklch{0.79, 0.155, 70},   // orange
    Oklch{0.90, 0.150, 102},  // yellow
    Oklch{0.98, 0.050, 106},  // nearly white
};

Oklab to_oklab(Oklch c) noexcept {
  const double hue = c.h * std::numbers::pi / 180;
  return {c.l, c.c * std::cos(hue), c.c * std::sin(hue)};
}

/// Catmull-Rom spline: the point at `t` between `b` and `c` on the smooth curve through all four.
Oklab between(Oklab a, Oklab b, Oklab c, Oklab d, double t) noexcept {
  const Oklab tangent_b = 0.5 * (c + -1 * a), tangent_c = 0.5 * (d + -1 * b);
  const double t2 = t * t, t3 = t2 * t;
  return (2 * t3 - 3 * t2 + 1) * b + (t3 - 2 * t2 + t) * tangent_b + (3 * t2 - 2 * t3) * c +
         (t3 - t2) * tangent_c;
}

/// The spline through kControlPoints, sampled finely.
std::vector<Oklab> curve() {
  constexpr int kPieces = 256;  // between two control points
  std::vector<Oklab> controls;
  std::ranges::transform(kControlPoints, std::back_inserter(controls), to_oklab);
  // Extrapolate linearly beyond both ends.
  controls.insert(controls.begin(), 2 * controls[0] + -1 * controls[1]);
  controls.push_back(2 * controls.back() + -1 * controls[controls.size() - 2]);
  std::vector<Oklab> points{controls[1]};
  for (std::size_t i = 1; i + 2 < controls.size(); ++i) {
    for (int k = 1; k <= kPieces; ++k) {
      points.push_back(between(controls[i - 1], controls[i], controls[i + 1], controls[i + 2],
                               static_cast<double>(k) / kPieces));
    }
  }
  return points;
}

constexpr std::size_t kSteps = 256;
using Table = std::array<Oklab, kSteps + 1>;

/// Resamples the curve at equal arc lengths.
Table make_table() {
  const std::vector<Oklab> points = curve();
  std::vector<double> length{0};
  for (std::size_t i = 1; i < points.size(); ++i) {
    length.push_back(length.back() + distance(points[i - 1], points[i]));
  }
  Table table{};
  std::size_t i = 1;
  for (std::size_t step = 0; step <= kSteps; ++step) {
    const double wanted = length.back() * static_cast<double>(step) / kSteps;
    while (i + 1 < points.size() && length[i] < wanted) ++i;
    const double t = (wanted - length[i - 1]) / (length[i] - length[i - 1]);
    table[step] = (1 - t) * points[i - 1] + t * points[i];
  }
  return table;
}

}  // namespace

LinearRgb mapped_color(double share) noexcept {
  static const Table table = make_table();
  // Written so that NaN gets the first colour.
  const double place = share > 0 ? std::min(share, 1.0) * kSteps : 0;
  const std::size_t step = std::min(static_cast<std::size_t>(place), kSteps - 1);
  const double t = place - static_cast<double>(step);
  return to_linear((1 - t) * table[step] + t * table[step + 1]);
}

Picture color_mapped(std::span<const float> values, int width, int height, double top) {
  Picture picture(width, height);
  std::ranges::transform(values, picture.pixels.begin(),
                         [&](float value) { return mapped_color(value / top); });
  return picture;
}

}  // namespace sdlc::render
