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

/// Statistics about paths.
struct PathCounts {
  std::uint64_t rays = 0;
  std::uint64_t truncated_paths = 0;  ///< cut off by the depth limit, counted as black

  PathCounts& operator+=(const PathCounts& other) noexcept {
    rays += other.rays;
    truncated_paths += other.truncated_paths;
    return *this;
  }
};

/// Estimates, from paths with connections to lights, what the same paths without connections would
/// give; summed over paths.
struct PlainPaths {
  /// An unbiased estimate of the squared contribution of a plain path, as a mean over channels.
  /// Paths that end at the first hit are excluded, because Sobol' points integrate them well. A
  /// connection represents the scattered rays that would have hit its light: with L the radiance,
  /// both count as L² times their weight in the balance heuristic, so light that scattering almost
  /// never finds is fully included.
  double squares = 0;
  std::uint64_t shadow_rays = 0;
  std::uint64_t connections = 0;  ///< shadow rays that reached their light
  std::uint64_t choices = 0;      ///< surfaces at which a light was chosen
};

/// Estimates radiance by random walks from the camera: no recursion, no state between paths. It
/// owns the traceable form of a scene (rebased to the camera, with a BVH), which all threads read.
class PathIntegrator {
 public:
  /// `scene` is in world coordinates and already checked. `max_depth` counts the rays of a path
  /// including the camera ray; at least 1. `near_pairs` is PrecisionBounds::near_pairs in double,
  /// if known. `lights` are the spheres from choose_lights(). `emitters` counts reached emitters;
  /// may be null.
  PathIntegrator(Scene scene, int max_depth,
                 std::optional<std::span<const SpherePair>> near_pairs = {},
                 std::span<const std::uint32_t> lights = {}, EmitterTally* emitters = nullptr);

  /// Traces one path through (s, t) of the image plane, where (0, 0) is the lower left corner;
  /// returns linear RGB. Once `cancel` is set a long path ends soon, with a meaningless value.
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
  std::vector<Departure> camera_surfaces_;  // spheres whose surface contains the camera
};

}  // namespace sdlc::render
