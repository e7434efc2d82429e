#include "render/exactness/lens_contact.hpp"

#include <cstddef>
#include <limits>
#include <vector>

#include "render/exactness/camera_view.hpp"
#include "render/exactness/suspects.hpp"
#include "render/parallel/ranges.hpp"
#include "render/scene/bounding_sphere.hpp"
#include "render/scene/instances.hpp"

namespace sdlc::render {
namespace {

/// Below this distance, in units of the radius, rounding decides which side of a surface a point is
/// on, as for a pinhole.
constexpr double kTouching = kCoincidenceTolerance;

bool meets_instances(const Scene& scene, const CameraView& view) {
  const std::vector<BoundingSphere> all_bounds = bounding_spheres(scene.prototypes);
  const CameraFrame& frame = view.frame();
  for (const Instance& instance : scene.instances) {
    const Prototype& prototype = scene.prototypes[instance.prototype];
    const BoundingSphere& bounds = all_bounds[instance.prototype];
    const Sphere around = placed(instance, {bounds.center, bounds.radius, 0});
    const Vec3 shift = frame.size(instance.shift);
    constexpr double kSlack = 1 + 0x1p-30;
    if (view.lens().clearance(frame.place(around.center), shift, 0) >
        frame.size(around.radius) * kSlack) {
      continue;
    }
    for (const Sphere& sphere : prototype.spheres) {
      const Sphere there = placed(instance, sphere);
      const double radius = frame.size(there.radius);
      const double clearance = view.lens().clearance(frame.place(there.center), shift, radius);
      if (there.radius > 0 && clearance <= kTouching * radius) return true;
    }
  }
  return false;
}

}  // namespace

std::optional<LensContact> find_lens_contact(const Scene& scene, const Camera& camera) {
  if (!camera.has_lens()) return std::nullopt;
  const CameraView view(scene, camera);
  constexpr auto kNone = std::numeric_limits<std::uint32_t>::max();
  const auto add = [&](std::uint32_t& first, std::size_t index) {
    const auto i = static_cast<std::uint32_t>(index);
    if (i < first && view.is_seen(i) && view.clearance(i) <= kTouching * view.radius(i)) first = i;
  };
  const auto join = [](std::uint32_t& first, std::uint32_t other) {
    first = std::min(first, other);
  };
  const std::uint32_t first = reduce_indices(view.count(), kNone, add, join);
  if (first != kNone) return LensContact{first};
  if (meets_instances(scene, view)) return LensContact{};
  return std::nullopt;
}

std::optional<NearestToLens> find_nearest_to_lens(const Scene& scene, const Camera& camera) {
  const CameraView view(scene, camera);
  std::optional<NearestToLens> nearest;
  for (std::uint32_t i = 0; i < view.count(); ++i) {
    if (!view.is_seen(i)) continue;
    const double distance = view.clearance(i);
    if (!nearest || distance < nearest->distance) nearest = NearestToLens{i, distance};
  }
  if (nearest) nearest->distance = view.frame().length_in_scene(nearest->distance);
  return nearest;
}

}  // namespace sdlc::render
