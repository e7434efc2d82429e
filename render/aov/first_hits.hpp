#pragma once

#include <cstdint>
#include <vector>

#include "render/bvh/bvh.hpp"
#include "render/camera/pinhole.hpp"
#include "render/math/color.hpp"
#include "render/math/ray.hpp"
#include "render/math/vec3.hpp"
#include "render/sampler/sampler.hpp"
#include "render/scene/rebase.hpp"
#include "render/scene/scene.hpp"

namespace sdlc::render {

/// The first surface on a camera ray.
struct FirstHit {
  bool is_hit = false;  ///< otherwise all members are 0
  Vec3 normal;          ///< unit length, facing the camera
  double depth = 0;     ///< along the view direction, in units of the rebased scene
  LinearRgb albedo;     ///< each component in [0, 1]
};

/// Traces camera rays through a scene, one at a time.
class FirstHits {
 public:
  /// `scene` is in world coordinates, checked, and without instances.
  explicit FirstHits(Scene scene);

  /// Traces the ray through (s, t) in the image plane, as PathIntegrator::sample does.
  FirstHit trace(double s, double t, const PathSampler& sampler) const noexcept;

  /// Converts a depth to units of the original scene.
  double depth_in_scene(double depth) const noexcept { return rebase_.length_in_scene(depth); }

 private:
  /// A sphere whose surface contains the camera. Rays can hit it only from inside; it is not in the
  /// BVH.
  struct CameraSurface {
    Vec3 normal;  ///< outward, at the camera
    double radius = 0;
    LinearRgb albedo;
  };

  void take_camera_surfaces(Scene& scene);
  template <bool kMoving>
  FirstHit trace(const Ray& ray) const noexcept;

  Pinhole pinhole_;
  Vec3 forward_;
  bool has_motion_;
  Rebase rebase_;
  Bvh bvh_;
  std::vector<LinearRgb> albedos_;  // by slot of the BVH
  std::vector<CameraSurface> camera_surfaces_;
};

}  // namespace sdlc::render
