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
  bool is_hit = false;  ///< else all is 0
  Vec3 normal;          ///< of length 1, to the side that the camera is on
  double depth = 0;     ///< along the view, in the unit of the rebased scene
  LinearRgb albedo;     ///< each component in [0, 1]
};

/// Camera rays through a scene, one at a time.
class FirstHits {
 public:
  /// `scene` is in world coordinates, checked, and without instances.
  explicit FirstHits(Scene scene);

  /// Through the place (s, t) of the picture, as PathIntegrator::sample.
  FirstHit trace(double s, double t, const PathSampler& sampler) const noexcept;

  /// A depth in the unit of the scene as it came.
  double depth_in_scene(double depth) const noexcept { return rebase_.length_in_scene(depth); }

 private:
  /// A sphere on whose surface the camera stands, which is met again only from inside, and is not
  /// in the hierarchy.
  struct CameraSurface {
    Vec3 normal;  ///< outward, where the camera stands
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
  std::vector<LinearRgb> albedos_;  // of the slots of the hierarchy
  std::vector<CameraSurface> camera_surfaces_;
};

}  // namespace sdlc::render
