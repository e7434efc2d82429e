#pragma once

#include "render/math/power_of_two.hpp"
#include "render/math/vec3.hpp"
#include "render/scene/scene.hpp"

namespace sdlc::render {

/// The directions that a camera's picture is made of.
class Pinhole {
 public:
  explicit Pinhole(const Camera& camera) noexcept {
    forward_ = unit(direction_between(camera.from, camera.at));
    const Vec3 right = unit(cross(forward_, with_moderate_length(camera.up)));
    across_ = right * (camera.plane_height * camera.aspect);
    upwards_ = cross(right, forward_) * camera.plane_height;
  }

  /// Unit direction through the place (s, t) of the picture: (0, 0) is its lower left corner, (1,
  /// 1) its upper right one.
  Vec3 direction(double s, double t) const noexcept {
    return unit(forward_ + across_ * (s - 0.5) + upwards_ * (t - 0.5));
  }

 private:
  Vec3 forward_, across_, upwards_;
};

}  // namespace sdlc::render
