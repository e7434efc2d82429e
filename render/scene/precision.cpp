#include "render/scene/precision.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "render/math/vec3.hpp"
#include "render/scene/rebase.hpp"

namespace sdlc::render {
namespace {

constexpr double kUnit = 0x1p-24;            // relative rounding error of float
constexpr double kHitError = 25 * kUnit;     // of a hit, in extents: the 99th percentile
constexpr double kAcrossError = 2 * kUnit;   // across the view, in extents
constexpr double kPointError = 2 * kUnit;    // of a point on a sphere, in its distance
constexpr double kPartOfRadius = 1.0 / 100;  // allowed for the error of a hit
constexpr double kPartOfPixel = 1.0 / 16;
constexpr double kNarrowestPixel = 16 * kUnit;
constexpr double kLeastGap = 0x1p-16;               // of the larger radius
constexpr double kLeastExactGap = 2 * kPointError;  // of its distance, where it is met in double
constexpr double kTouching = 0x1p-40;               // of the larger radius: as good as no gap
constexpr double kMostRadiance = 1e30;
constexpr double kWidestView = 1e6;

/// The bounds for one scene, rebased.
class FloatJudge {
 public:
  FloatJudge(const Scene& scene, int height)
      : scene_(scene), pixel_(scene.camera.plane_height / std::max(1, height)) {
    for (std::uint32_t i = 0; i < scene.spheres.size(); ++i) {
      if (scene.spheres[i].radius > 0) by_size_.push_back(i);
    }
    std::stable_sort(by_size_.begin(), by_size_.end(), [&](std::uint32_t a, std::uint32_t b) {
      return scene.spheres[a].radius > scene.spheres[b].radius;
    });
  }

  /// What is wrong when the `exact` largest spheres are met in double; nullptr: nothing.
  const char* objection(std::size_t exact) const {
    if (pixel_ < kNarrowestPixel) return "pixels are narrower than float resolves";
    if (scene_.camera.plane_height * std::max(1.0, scene_.camera.aspect) > kWidestView) {
      return "the view is too wide for float";
    }
    if (has_large_radiance()) return "radiance is too large for float";
    const auto rest = std::span(by_size_).subspan(exact);
    if (rest.empty()) return exact == 0 ? nullptr : "no sphere is left for float";
    const double smallest = scene_.spheres[rest.back()].radius;
    double extent = 0;
    for (const std::uint32_t i : rest) extent = std::max(extent, extent_of(i));
    if (kHitError * extent > kPartOfRadius * smallest) {
      return "the scene is too large for its smallest sphere";
    }
    for (const std::uint32_t i : rest) {
      const double distance =
          std::fabs(length(scene_.spheres[i].center) - scene_.spheres[i].radius);
      const bool is_at_camera = distance <= kTouching * scene_.spheres[i].radius;
      if (!is_at_camera && kAcrossError * extent > kPartOfPixel * pixel_ * distance) {
        return "a sphere is so near that rounding shows";
      }
    }
    for (std::size_t k = 0; k < exact; ++k) {
      if (kPointError * extent_of(by_size_[k]) > kPartOfRadius * smallest) {
        return "the scene is too large for its smallest sphere";
      }
    }
    return has_narrow_gap(exact) ? "surfaces are too close to each other" : nullptr;
  }

  std::vector<std::uint32_t> largest(std::size_t count) const {
    return {by_size_.begin(), by_size_.begin() + static_cast<std::ptrdiff_t>(count)};
  }

  std::size_t count() const { return by_size_.size(); }

 private:
  Vec3 shift(std::uint32_t i) const { return scene_.shifts.empty() ? Vec3{} : scene_.shifts[i]; }

  double extent_of(std::uint32_t i) const {
    const Sphere& sphere = scene_.spheres[i];
    return std::max(length(sphere.center), length(sphere.center + shift(i))) + sphere.radius;
  }

  bool has_large_radiance() const {
    const auto is_large = [](LinearRgb c) { return std::max({c.r, c.g, c.b}) > kMostRadiance; };
    return is_large(scene_.background.bottom) || is_large(scene_.background.top) ||
           std::any_of(scene_.materials.begin(), scene_.materials.end(), [&](const Material& m) {
             return is_large(m.color) || m.parameter > kMostRadiance ||
                    is_large(m.color * m.parameter);
           });
  }

  /// Of spheres that move apart or together only the ends of the shutter are looked at.
  bool has_narrow_gap(std::size_t exact) const {
    for (std::size_t k = 0; k < by_size_.size(); ++k) {
      const std::uint32_t i = by_size_[k];
      const double larger = scene_.spheres[i].radius;
      const double least = k < exact ? kLeastExactGap * extent_of(i) : kLeastGap * larger;
      for (const std::uint32_t j : std::span(by_size_).subspan(k + 1)) {
        const double smaller = scene_.spheres[j].radius;
        for (const double time : {0.0, 1.0}) {
          const double distance = length(scene_.spheres[i].center + shift(i) * time -
                                         scene_.spheres[j].center - shift(j) * time);
          for (const double gap :
               {std::fabs(distance - larger - smaller), std::fabs(distance - (larger - smaller))}) {
            if (gap > kTouching * larger && gap < least) return true;
          }
        }
      }
    }
    return false;
  }

  const Scene& scene_;
  double pixel_;                        // its angle, next to the axis
  std::vector<std::uint32_t> by_size_;  // the largest first
};

}  // namespace

FloatVerdict judge_float(const Scene& scene, int height, std::size_t most_exact) {
  Scene rebased = scene;
  rebase_to_camera(rebased);
  const FloatJudge judge(rebased, height);
  const char* first_objection = judge.objection(0);
  if (first_objection == nullptr) return {.is_accepted = true, .exact_spheres = {}, .reason = {}};
  for (std::size_t exact = 1; exact <= std::min(most_exact, judge.count()); ++exact) {
    if (judge.objection(exact) == nullptr) {
      return {
          .is_accepted = true, .exact_spheres = judge.largest(exact), .reason = first_objection};
    }
  }
  return {.is_accepted = false, .exact_spheres = {}, .reason = first_objection};
}

}  // namespace sdlc::render
