#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "render/bvh/bvh.hpp"
#include "render/camera/pinhole.hpp"
#include "render/light/emitter_tally.hpp"
#include "render/light/lights.hpp"
#include "render/math/color.hpp"
#include "render/math/ray.hpp"
#include "render/sampler/sampler.hpp"
#include "render/scene/near_pairs.hpp"
#include "render/scene/scene.hpp"

namespace sdlc::render {

/// What happened to paths, for the statistics of a picture.
struct PathCounts {
  std::uint64_t rays = 0;
  std::uint64_t truncated_paths = 0;  ///< cut off by the depth limit, counted as black

  PathCounts& operator+=(const PathCounts& other) noexcept {
    rays += other.rays;
    truncated_paths += other.truncated_paths;
    return *this;
  }
};

/// What paths that look for lights say of the same paths without that; added up over paths.
struct PlainPaths {
  /// An unbiased estimate of the square of what the plain path brings, the mean over channels; of
  /// paths that end where the camera ray does nothing, as Sobol' points make short work of them. A
  /// connection stands for the scattered rays that would have hit its light: with L the radiance,
  /// both count as L² times their weight in the balance heuristic, so light that scattering
  /// hardly ever finds counts in full.
  double squares = 0;
  std::uint64_t shadow_rays = 0;
  std::uint64_t connections = 0;  ///< shadow rays that found their light
  std::uint64_t choices = 0;      ///< surfaces at which a light was looked for
};

/// Estimates radiance by random walks from the camera: no recursion, no state between paths. It
/// owns what a scene becomes for tracing (rebased to the camera, in a hierarchy) and is read by all
/// threads.
class PathIntegrator {
 public:
  /// `scene` is in world coordinates and already checked. `max_depth` counts the rays of a path,
  /// the camera's included; at least 1.
  /// `near_pairs`: PrecisionBounds::near_pairs in double, if they are known; `lights`: the spheres
  /// of choose_lights(); `emitters`: where to count what paths reach, if at all.
  PathIntegrator(Scene scene, int max_depth,
                 std::optional<std::span<const SpherePair>> near_pairs = {},
                 std::span<const std::uint32_t> lights = {}, EmitterTally* emitters = nullptr);

  /// One path through the place (s, t) of the picture, (0, 0) its lower left corner: linear RGB.
  /// Once `cancel` is set a long path ends soon, with a value that means nothing.
  LinearRgb sample(double s, double t, const PathSampler& sampler, PathCounts& counts,
                   const std::atomic<bool>* cancel = nullptr,
                   PlainPaths* plain = nullptr) const noexcept;

  bool has_motion() const noexcept { return has_motion_; }
  const Bvh& bvh() const noexcept { return bvh_; }

 private:
  template <bool kMoving>
  LinearRgb li(Ray ray, const PathSampler& sampler, PathCounts& counts,
               const std::atomic<bool>* cancel, PlainPaths* plain) const noexcept;
  template <bool kMoving>
  LinearRgb direct_light(const Ray& ray, const Departure& departure, Vec3 facing,
                         const PathSampler& sampler, int vertex, LinearRgb beta, PathCounts& counts,
                         PlainPaths* plain) const noexcept;
  template <bool kMoving>
  BvhHit first_hit_from_surfaces(const Ray& ray) const noexcept;
  LinearRgb background(Vec3 direction) const noexcept;
  void find_camera_surfaces();
  void count_reached(std::uint32_t sphere, LightPath kind) const noexcept {
    if (emitters_ != nullptr && emitters_->is_counting()) emitters_->count(sphere, kind);
  }

  Pinhole pinhole_;
  Background background_;
  bool has_constant_background_;
  bool has_motion_;
  int max_depth_;
  Bvh bvh_;
  Lights lights_;
  EmitterTally* emitters_;
  std::vector<Material> materials_;
  std::vector<std::uint32_t> material_of_slot_;
  std::vector<Departure> camera_surfaces_;  // spheres on whose surface the camera stands
};

}  // namespace sdlc::render
