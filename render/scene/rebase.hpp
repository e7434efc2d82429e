#pragma once

#include <cmath>
#include <cstdint>
#include <span>

#include "render/scene/ball.hpp"
#include "render/scene/scene.hpp"

namespace sdlc::render {

/// Lengths of a scene as seen from a camera, in a unit of its own: of moderate size, so that no
/// difference overflows.
class CameraFrame {
 public:
  CameraFrame(const Scene& scene, Vec3 camera);

  double size(double v) const noexcept { return v * first_ * second_; }
  Vec3 size(Vec3 v) const noexcept { return {size(v.x), size(v.y), size(v.z)}; }
  /// A length of this frame in the scene's own unit.
  double length_in_scene(double v) const noexcept { return v / second_ / first_; }
  /// From the camera to a place.
  Vec3 place(Vec3 v) const noexcept { return size(v) - origin_; }

 private:
  double first_, second_;  // a power of two; one factor alone may be no double
  Vec3 origin_;
};

/// The length of what has squares that vanish or overflow; of what has not, but for rounding, too.
double length_of_extreme(Vec3 v) noexcept;

/// The length, where squares would vanish or overflow too.
inline double moderate_length(Vec3 v) noexcept {
  // No square of a part that counts comes near the ends of double, and rounding is that of
  // length().
  constexpr double kLeast = 0x1p-800, kMost = 0x1p800;
  const double squared = length_squared(v);
  return squared >= kLeast && squared < kMost ? std::sqrt(squared) : length_of_extreme(v);
}

/// What rebase_to_camera() makes of a scene's spheres, to look at without a copy of all of them.
class Rebase {
 public:
  explicit Rebase(const Scene& scene, std::span<const std::uint32_t> left_out = {});

  Sphere sphere(const Sphere& s) const noexcept {
    return {
        .center = scaled(frame_.place(s.center)), .radius = size(s.radius), .material = s.material};
  }
  Vec3 shift(Vec3 v) const noexcept { return scaled(frame_.size(v)); }
  /// A length of the rebased scene in the unit of the one before; may overflow.
  double length_in_scene(double v) const noexcept {
    return frame_.length_in_scene(v / second_ / first_);
  }
  /// Of the prototype as center_prototype() makes it; `ball` is the one around it before.
  Instance instance(const Instance& from, const Ball& ball) const noexcept;

 private:
  double size(double v) const noexcept { return frame_.size(v) * first_ * second_; }
  Vec3 scaled(Vec3 v) const noexcept { return v * first_ * second_; }

  CameraFrame frame_;
  double first_, second_;  // a power of two in two factors, as in CameraFrame
};

/// Puts the middle of a prototype to the origin and scales it by a power of two so that the radius
/// of `ball`, the one around it, lies in [1, 2).
void center_prototype(Prototype& prototype, const Ball& ball) noexcept;

/// Moves the scene so that the camera stands at the origin and scales it by a power of two so that
/// its extent E = max(|centre| + radius), over both ends of the shutter, lies in [1, 2); the
/// spheres `left_out` do not count where there are others. The picture stays the same, bit for bit
/// under scaling by powers of two, and no longer depends on where in the world the scene is;
/// squares of lengths can neither overflow nor vanish. Prototypes are centred, and instances put
/// them where they were. Afterwards camera.at − camera.from is only a direction.
void rebase_to_camera(Scene& scene, std::span<const std::uint32_t> left_out = {});

}  // namespace sdlc::render
