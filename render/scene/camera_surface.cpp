#include "render/scene/camera_surface.hpp"

#include "render/scene/rebase.hpp"

namespace sdlc::render {

std::size_t count_under_camera(const Scene& scene) noexcept {
  // The claim is relative, but squares of what is small beside the scene's extent vanish: only in
  // the very unit of the rebased scene is the answer the same as there.
  const Rebase rebase(scene);
  std::size_t count = 0;
  for (std::size_t i = 0; i < scene.spheres.size(); ++i) {
    const Vec3 shift = scene.shifts.empty() ? Vec3{} : rebase.shift(scene.shifts[i]);
    count += has_camera_on_it(rebase.sphere(scene.spheres[i]), shift) ? 1 : 0;
  }
  return count;
}

}  // namespace sdlc::render
