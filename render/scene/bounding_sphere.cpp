#include "render/scene/bounding_sphere.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>

#include "render/math/power_of_two.hpp"

namespace sdlc::render {
namespace {

/// The centre of sphere `i` at shutter closing.
Vec3 closing(const Prototype& prototype, std::size_t i) noexcept {
  const Vec3 center = prototype.spheres[i].center;
  return prototype.shifts.empty() ? center : center + prototype.shifts[i];
}

}  // namespace

BoundingSphere bounding_sphere(const Prototype& prototype) noexcept {
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
  BoundingSphere bounds{.center = low * 0.5 + high * 0.5, .radius = 0};
  for (std::size_t i = 0; i < prototype.spheres.size(); ++i) {
    const double from_center =
        std::max(moderate_length(prototype.spheres[i].center - bounds.center),
                 moderate_length(closing(prototype, i) - bounds.center));
    bounds.radius = std::max(bounds.radius, from_center + prototype.spheres[i].radius);
  }
  return bounds;
}

std::vector<BoundingSphere> bounding_spheres(const std::vector<Prototype>& prototypes) {
  std::vector<BoundingSphere> all_bounds;
  all_bounds.reserve(prototypes.size());
  for (const Prototype& prototype : prototypes) all_bounds.push_back(bounding_sphere(prototype));
  return all_bounds;
}

}  // namespace sdlc::render
