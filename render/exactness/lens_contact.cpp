#include "render/exactness/lens_contact.hpp"

#include <algorithm>
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

/// Calls visit(clearance, radius) for the spheres of each instance whose bounding sphere may be as
/// near to the lens as `reach`, which a visit may shorten. Ends, and returns true, if `visit`
/// returns true.
template <typename Visit>
bool visit_instanced(const Scene& scene, const CameraView& view, const double& reach,
                     const Visit& visit) {
  const std::vector<BoundingSphere> all_bounds = bounding_spheres(scene.prototypes);
  const CameraFrame& frame = view.frame();
  const auto clearance = [&](const Sphere& there, Vec3 shift, double radius) {
    return view.lens().clearance(frame.place(there.center), frame.size(shift), radius);
  };
  for (const Instance& instance : scene.instances) {
    const Prototype& prototype = scene.prototypes[instance.prototype];
    const BoundingSphere& bounds = all_bounds[instance.prototype];
    const Sphere around = placed(instance, {bounds.center, bounds.radius, 0});
    constexpr double kSlack = 1 + 0x1p-30;
    if (clearance(around, instance.shift, 0) - frame.size(around.radius) * kSlack > reach) continue;
    for (std::size_t i = 0; i < prototype.spheres.size(); ++i) {
      const Sphere there = placed(instance, prototype.spheres[i]);
      const Vec3 shift = prototype.shifts.empty() ? Vec3{} : prototype.shifts[i];
      const double radius = frame.size(there.radius);
      if (there.radius <= 0) continue;
      if (visit(clearance(there, placed_shift(instance, shift), radius), radius)) return true;
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
  const bool is_met = visit_instanced(scene, view, 0, [](double clearance, double radius) {
    return clearance <= kTouching * radius;
  });
  return is_met ? std::optional(LensContact{}) : std::nullopt;
}

std::optional<NearestToLens> find_nearest_to_lens(const Scene& scene, const Camera& camera,
                                                  double within) {
  const CameraView view(scene, camera);
  std::optional<NearestToLens> nearest;
  double reach = view.frame().size(within);
  const auto take = [&](std::optional<std::uint32_t> sphere, double distance) {
    if (distance >= reach) return;
    reach = distance;
    nearest = {.sphere = sphere, .distance = view.frame().length_in_scene(distance)};
  };
  for (std::uint32_t i = 0; i < view.count(); ++i) {
    if (view.is_seen(i)) take(i, view.clearance(i));
  }
  visit_instanced(scene, view, reach, [&](double clearance, double) {
    take({}, clearance);
    return false;
  });
  return nearest;
}

}  // namespace sdlc::render
