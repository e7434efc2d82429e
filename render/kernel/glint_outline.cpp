#include "render/kernel/glint_outline.hpp"

#include <algorithm>
#include <cstddef>
#include <tuple>

namespace sdlc::render {
namespace {

using Place = Glint::Place;

Rectangle bounds_of(const std::vector<Place>& outline) {
  Rectangle bounds{outline[0].x, outline[0].x, outline[0].y, outline[0].y};
  for (const Place& at : outline) {
    bounds.left = std::min(bounds.left, at.x);
    bounds.right = std::max(bounds.right, at.x);
    bounds.bottom = std::min(bounds.bottom, at.y);
    bounds.top = std::max(bounds.top, at.y);
  }
  return bounds;
}

/// The part of the outline where a x + b y ≤ c.
std::vector<Place> clipped(const std::vector<Place>& outline, double a, double b, double c) {
  std::vector<Place> part;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Place from = outline[i], to = outline[(i + 1) % outline.size()];
    const double before = a * from.x + b * from.y - c, after = a * to.x + b * to.y - c;
    if (before <= 0) part.push_back(from);
    if ((before <= 0) == (after <= 0)) continue;
    const double share = before / (before - after);
    part.push_back({from.x + share * (to.x - from.x), from.y + share * (to.y - from.y)});
  }
  return part;
}

}  // namespace

// Sutherland, Hodgman, "Reentrant polygon clipping", 1974.
std::optional<Rectangle> part_in_pixel(std::vector<Place> outline) {
  const Rectangle whole = bounds_of(outline);
  if (whole.left >= 1 || whole.right <= 0 || whole.bottom >= 1 || whole.top <= 0) {
    return std::nullopt;
  }
  for (const auto& [a, b, c] :
       {std::tuple{1.0, 0.0, 1.0}, {-1.0, 0.0, 0.0}, {0.0, 1.0, 1.0}, {0.0, -1.0, 0.0}}) {
    outline = clipped(outline, a, b, c);
    if (outline.empty()) return std::nullopt;
  }
  constexpr double kMargin = 0.01;  // a sixteenth of a quarter turn bulges by less
  const double across = kMargin * (whole.right - whole.left);
  const double up = kMargin * (whole.top - whole.bottom);
  const Rectangle part = bounds_of(outline);
  return Rectangle{std::max(part.left - across, 0.0), std::min(part.right + across, 1.0),
                   std::max(part.bottom - up, 0.0), std::min(part.top + up, 1.0)};
}

}  // namespace sdlc::render
