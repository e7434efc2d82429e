#include "render/scene/camera_surface.hpp"

#include "render/scene/instances.hpp"
#include "render/scene/ranges.hpp"
#include "render/scene/rebase.hpp"

namespace sdlc::render {

std::size_t count_under_camera(const Scene& scene) {
  // The claim is relative, but squares of what is small beside the scene's extent vanish: only in
  // the very unit of the rebased scene is the answer the same as there.
  const Rebase rebase(scene);
  const auto add = [&](std::size_t& count, std::size_t i) {
    const Vec3 shift = scene.shifts.empty() ? Vec3{} : rebase.shift(scene.shifts[i]);
    count += has_camera_on_it(rebase.sphere(scene.spheres[i]), shift) ? 1 : 0;
  };
  const std::size_t of_its_own =
      reduce_indices(scene.spheres.size(), std::size_t{0}, add,
                     [](std::size_t& count, std::size_t other) { count += other; });
  return of_its_own + find_instanced_under_camera(scene).size();
}

}  // namespace sdlc::render
