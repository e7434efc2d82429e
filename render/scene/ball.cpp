#include "render/scene/ball.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>

#include "render/scene/rebase.hpp"

namespace sdlc::render {
namespace {

/// Where a sphere of the prototype is at the closing of the shutter.
Vec3 closing(const Prototype& prototype, std::size_t i) noexcept {
  const Vec3 center = prototype.spheres[i].center;
  return prototype.shifts.empty() ? center : center + prototype.shifts[i];
}

}  // namespace

Ball ball_around(const Prototype& prototype) noexcept {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Vec3 low{kInfinity, kInfinity, kInfinity}, high = -low;
  const auto take = [&](Vec3 p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  };
  for (std::size_t i = 0; i < prototype.spheres.size(); ++i) {
    take(prototype.spheres[i].center);
    take(closing(prototype, i));
  }
  Ball ball{.center = low * 0.5 + high * 0.5, .radius = 0};
  for (std::size_t i = 0; i < prototype.spheres.size(); ++i) {
    const double from_middle = std::max(moderate_length(prototype.spheres[i].center - ball.center),
                                        moderate_length(closing(prototype, i) - ball.center));
    ball.radius = std::max(ball.radius, from_middle + prototype.spheres[i].radius);
  }
  return ball;
}

std::vector<Ball> balls_around(const std::vector<Prototype>& prototypes) {
  std::vector<Ball> balls;
  balls.reserve(prototypes.size());
  for (const Prototype& prototype : prototypes) balls.push_back(ball_around(prototype));
  return balls;
}

}  // namespace sdlc::render
