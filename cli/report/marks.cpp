#include "cli/report/marks.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <fmt/format.h>

namespace sdlc::cli {
namespace {

struct Corner {
  double x, y;
};

/// Corners at equal angles, starting at the top; with `inner`, every second corner is at that
/// distance (a star).
std::vector<Corner> corners(int count, double turn, double outer = 1, double inner = 1) {
  std::vector<Corner> all;
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * (i + turn) / count;
    const double radius = i % 2 == 0 ? outer : inner;
    all.push_back({radius * std::sin(angle), -radius * std::cos(angle)});
  }
  return all;
}

/// All have about the same area, so that none stands out.
std::vector<Corner> shape(std::size_t style) {
  constexpr double kArm = 0.38;
  switch (style % kSeriesStyles) {
    case 0: return corners(32, 0);               // a circle
    case 1: return corners(4, 0.5, 1.25, 1.25);  // a square
    case 2: return corners(3, 0, 1.35, 1.35);    // a triangle
    case 3: return corners(4, 0, 1.3, 1.3);      // a diamond
    case 4: return corners(3, 1.5, 1.35, 1.35);  // a triangle upside down
    case 5: return corners(10, 0, 1.5, 0.65);    // a star
    case 6:                                      // a cross
      return {{-kArm, -1.2}, {kArm, -1.2}, {kArm, -kArm}, {1.2, -kArm},
              {1.2, kArm},   {kArm, kArm}, {kArm, 1.2},   {-kArm, 1.2},
              {-kArm, kArm}, {-1.2, kArm}, {-1.2, -kArm}, {-kArm, -kArm}};
    default: return corners(6, 0.5, 1.15, 1.15);  // a hexagon
  }
}

}  // namespace

std::string mark_outline(std::size_t style, double radius) {
  std::string path;
  for (const Corner& corner : shape(style)) {
    path += fmt::format("{}{:.2f},{:.2f}", path.empty() ? 'M' : 'L', radius * corner.x,
                        radius * corner.y);
  }
  return path + "Z";
}

std::string_view dashes(std::size_t style) {
  static constexpr std::array<std::string_view, kSeriesStyles> kDashes{
      "none", "7 3", "2 3", "9 3 2 3", "4 2", "12 4", "9 3 2 3 2 3", "1 4"};
  return kDashes[style % kSeriesStyles];
}

}  // namespace sdlc::cli
