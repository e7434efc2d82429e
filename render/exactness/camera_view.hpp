#pragma once

#include <algorithm>
#include <cstdint>

#include "render/exactness/lens_disc.hpp"
#include "render/exactness/rebase.hpp"
#include "render/math/power_of_two.hpp"
#include "render/scene/scene.hpp"

namespace sdlc::render {

/// A scene's spheres as seen from a camera, by index. Lengths have moderate size, are all in one
/// unit, and are not rounded. Keeps a reference to the scene.
class CameraView {
 public:
  /// From a pinhole.
  CameraView(const Scene& scene, Vec3 camera) : scene_(scene), frame_(scene, camera) {}
  CameraView(const Scene& scene, const Camera& camera)
      : scene_(scene), frame_(scene, camera.from), lens_(lens_of(camera, frame_)) {}

  std::uint32_t count() const noexcept { return static_cast<std::uint32_t>(scene_.spheres.size()); }
  const CameraFrame& frame() const noexcept { return frame_; }
  bool is_moving() const noexcept { return !scene_.shifts.empty(); }
  /// A radius that underflows in this unit still counts.
  bool is_seen(std::uint32_t i) const noexcept { return scene_.spheres[i].radius > 0; }

  double radius(std::uint32_t i) const noexcept { return frame_.size(scene_.spheres[i].radius); }
  Vec3 opening(std::uint32_t i) const noexcept { return frame_.place(scene_.spheres[i].center); }
  Vec3 closing(std::uint32_t i) const noexcept {
    return is_moving() ? opening(i) + frame_.size(scene_.shifts[i]) : opening(i);
  }
  const LensDisc& lens() const noexcept { return lens_; }
  /// LensDisc::clearance() of a sphere.
  double clearance(std::uint32_t i) const noexcept {
    return lens_.clearance(opening(i), closing(i) - opening(i), radius(i));
  }
  /// An upper limit for the distance from the camera, or from any point of its lens, to the far
  /// side, over the whole shutter.
  double extent(std::uint32_t i) const noexcept {
    const double opened = moderate_length(opening(i));
    return (is_moving() ? std::max(opened, moderate_length(closing(i))) : opened) + radius(i) +
           lens_.radius();
  }

 private:
  static LensDisc lens_of(const Camera& camera, const CameraFrame& frame) noexcept {
    if (!camera.has_lens()) return {};
    return {unit(direction_between(camera.from, camera.at)), frame.size(camera.aperture) / 2};
  }

  const Scene& scene_;
  CameraFrame frame_;
  LensDisc lens_;
};

}  // namespace sdlc::render
