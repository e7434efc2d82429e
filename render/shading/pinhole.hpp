#pragma once

#include "render/math/power_of_two.hpp"
#include "render/math/vec3.hpp"
#include "render/scene/scene.hpp"

namespace sdlc::render {

/// The view directions of a camera: maps points of the image plane to rays.
class Pinhole {
 public:
  explicit Pinhole(const Camera& camera) noexcept {
    forward_ = unit(direction_between(camera.from, camera.at));
    const Vec3 right = unit(cross(forward_, with_moderate_length(camera.up)));
    across_ = right * (camera.plane_height * camera.aspect);
    upwards_ = cross(right, forward_) * camera.plane_height;
  }

  /// The vector from the camera to (s, t) on the image plane at distance 1: (0, 0) is the lower
  /// left corner of the picture, (1, 1) the upper right one.
  Vec3 place(double s, double t) const noexcept {
    return forward_ + across_ * (s - 0.5) + upwards_ * (t - 0.5);
  }
  /// The unit direction through the same point.
  Vec3 direction(double s, double t) const noexcept { return unit(place(s, t)); }

  /// The vectors along the lower edge and the left edge of the picture.
  Vec3 across() const noexcept { return across_; }
  Vec3 upwards() const noexcept { return upwards_; }

 private:
  Vec3 forward_, across_, upwards_;
};

}  // namespace sdlc::render
