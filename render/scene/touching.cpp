#include "render/scene/touching.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <vector>

#include "render/scene/camera_surface.hpp"

namespace sdlc::render {
namespace {

// Of a point's distance to another surface, in units of rounding times an extent, at most.
constexpr double kPointError = 4;
constexpr double kMostOfRadius = 1.0 / 64;

class Parting {
 public:
  Parting(Scene& scene, double unit, std::span<const std::uint32_t> exact)
      : scene_(scene), unit_(unit), radii_(scene.spheres.size()) {
    for (std::uint32_t i = 0; i < scene.spheres.size(); ++i) {
      radii_[i] = scene.spheres[i].radius;
      extents_.push_back(std::max(length(opening(i)), length(closing(i))) + radii_[i]);
      is_exact_.push_back(std::find(exact.begin(), exact.end(), i) != exact.end());
    }
  }

  void run() {
    std::vector<std::uint32_t> order(radii_.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return radii_[a] > radii_[b]; });
    for (std::size_t k = 1; k < order.size(); ++k) {
      const std::uint32_t small = order[k];
      if (!may_shrink(small)) continue;
      const double least = (1 - kMostOfRadius) * radii_[small];
      double radius = radii_[small];
      for (const std::uint32_t large : std::span(order).first(k)) {
        radius = std::min(radius, parted(large, small));
      }
      if (radius >= least) scene_.spheres[small].radius = radius;
    }
  }

 private:
  Vec3 opening(std::uint32_t i) const { return scene_.spheres[i].center; }
  Vec3 closing(std::uint32_t i) const {
    return scene_.shifts.empty() ? opening(i) : opening(i) + scene_.shifts[i];
  }

  bool may_shrink(std::uint32_t i) const {
    const Vec3 shift = scene_.shifts.empty() ? Vec3{} : scene_.shifts[i];
    return radii_[i] > 0 && !has_camera_on_it(scene_.spheres[i], shift);
  }

  /// The radius of `small` so that it is apart from `large`, which has its own already.
  double parted(std::uint32_t large, std::uint32_t small) const {
    const double error = kPointError * unit_ * extent(large, small);
    const double now = scene_.spheres[large].radius, before = radii_[large];
    const Vec3 from = opening(large) - opening(small);
    const Vec3 way = closing(large) - closing(small) - from;
    const double nearest = length(from + way * nearest_moment(from, way));
    const double farthest = std::max(length(from), length(from + way));
    double radius = radii_[small];
    const bool touches_outside = std::fabs(nearest - before - radius) < error;
    const bool touches_inside = std::fabs(before - radius - farthest) < error;
    if (touches_outside) radius = std::min(radius, nearest - now - error);
    if (touches_inside) radius = std::min(radius, now - farthest - error);
    return radius;
  }

  /// Where the two are near each other, how far that is from the camera at most.
  double extent(std::uint32_t a, std::uint32_t b) const {
    if (is_exact_[a] != is_exact_[b]) return extents_[is_exact_[a] ? b : a];
    return std::max(extents_[a], extents_[b]);
  }

  static double nearest_moment(Vec3 from, Vec3 way) {
    const double squared = length_squared(way);
    return squared > 0 ? std::clamp(-dot(from, way) / squared, 0.0, 1.0) : 0;
  }

  Scene& scene_;
  double unit_;
  std::vector<double> radii_, extents_;  // before anything is parted
  std::vector<bool> is_exact_;
};

}  // namespace

void part_touching(Scene& scene, Precision precision, std::span<const std::uint32_t> exact) {
  if (scene.spheres.size() > kMostSpheresForGaps) return;
  Parting(scene, unit_of_rounding(precision), exact).run();
}

}  // namespace sdlc::render
