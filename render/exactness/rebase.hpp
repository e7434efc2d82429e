#pragma once

#include <cmath>
#include <cstdint>
#include <span>

#include "render/math/power_of_two.hpp"
#include "render/scene/bounding_sphere.hpp"
#include "render/scene/scene.hpp"

namespace sdlc::render {

/// Converts lengths of a scene to a unit of moderate size relative to a camera, so that no
/// difference overflows.
class CameraFrame {
 public:
  CameraFrame(const Scene& scene, Vec3 camera);

  double size(double v) const noexcept { return v * first_ * second_; }
  Vec3 size(Vec3 v) const noexcept { return {size(v.x), size(v.y), size(v.z)}; }
  /// Converts a length of this frame to the scene's unit.
  double length_in_scene(double v) const noexcept { return v / second_ / first_; }
  /// The unit of this frame is the scene's divided by this power of two.
  int exponent() const noexcept { return std::ilogb(first_) + std::ilogb(second_); }
  /// The vector from the camera to a point.
  Vec3 place(Vec3 v) const noexcept { return size(v) - origin_; }

 private:
  double first_, second_;  // a power of two as two factors, because one may not fit in a double
  Vec3 origin_;
};

/// Applies rebase_to_camera() to individual spheres, without a copy of the scene.
class Rebase {
 public:
  explicit Rebase(const Scene& scene, std::span<const std::uint32_t> left_out = {});

  Sphere sphere(const Sphere& s) const noexcept {
    return {
        .center = scaled(frame_.place(s.center)), .radius = size(s.radius), .material = s.material};
  }
  Vec3 shift(Vec3 v) const noexcept { return scaled(frame_.size(v)); }
  double length(double v) const noexcept { return size(v); }
  /// Converts a length of the rebased scene to the original unit; may overflow.
  double length_in_scene(double v) const noexcept {
    return frame_.length_in_scene(v / second_ / first_);
  }
  /// The unit of the rebased scene is the original one divided by this power of two.
  int exponent() const noexcept {
    return frame_.exponent() + std::ilogb(first_) + std::ilogb(second_);
  }
  /// The instance for the prototype after center_prototype(); `bounds` is the prototype's bounding
  /// sphere before that.
  Instance instance(const Instance& from, const BoundingSphere& bounds) const noexcept;

 private:
  double size(double v) const noexcept { return frame_.size(v) * first_ * second_; }
  Vec3 scaled(Vec3 v) const noexcept { return v * first_ * second_; }

  CameraFrame frame_;
  double first_, second_;  // a power of two as two factors, as in CameraFrame
};

/// Moves the centre of a prototype's bounding sphere, `bounds`, to the origin and scales the
/// prototype by a power of two, so that the bounding radius is in [1, 2).
void center_prototype(Prototype& prototype, const BoundingSphere& bounds) noexcept;

/// Moves the scene so that the camera is at the origin, and scales it by a power of two so that its
/// extent E = max(|centre| + radius) plus the radius of the lens, over both ends of the shutter, is
/// in [1, 2). The spheres `left_out` do not count if there are others.
///
/// The picture stays the same (scaling by powers of two is exact) and no longer depends on the
/// scene's position in the world; squares of lengths neither overflow nor underflow. Prototypes are
/// centred, and instances compensate for it. Afterwards only the direction of camera.at −
/// camera.from is meaningful.
void rebase_to_camera(Scene& scene, std::span<const std::uint32_t> left_out = {});

}  // namespace sdlc::render
