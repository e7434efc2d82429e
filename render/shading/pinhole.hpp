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
    right_ = unit(cross(forward_, with_moderate_length(camera.up)));
    up_ = cross(right_, forward_);
    across_ = right_ * (camera.plane_height * camera.aspect);
    upwards_ = up_ * camera.plane_height;
  }

  /// The vector from the camera to (s, t) on the image plane at distance 1: (0, 0) is the lower
  /// left corner of the picture, (1, 1) the upper right one.
  Vec3 place(double s, double t) const noexcept {
    return forward_ + across_ * (s - 0.5) + upwards_ * (t - 0.5);
  }
  /// The unit direction through the same point.
  Vec3 direction(double s, double t) const noexcept { return unit(place(s, t)); }

  /// The unit vectors to the right and upwards in the picture.
  Vec3 right() const noexcept { return right_; }
  Vec3 up() const noexcept { return up_; }
  /// The vectors along the lower edge and the left edge of the picture.
  Vec3 across() const noexcept { return across_; }
  Vec3 upwards() const noexcept { return upwards_; }

 private:
  Vec3 forward_, right_, up_, across_, upwards_;
};

}  // namespace sdlc::render
