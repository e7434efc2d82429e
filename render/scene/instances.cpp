#include "render/scene/instances.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "render/scene/bounding_sphere.hpp"
#include "render/scene/camera_surface.hpp"
#include "render/scene/ranges.hpp"
#include "render/scene/suspects.hpp"

namespace sdlc::render {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double smallest_radius(const Prototype& prototype) noexcept {
  double smallest = kInfinity;
  for (const Sphere& sphere : prototype.spheres) {
    if (sphere.radius > 0) smallest = std::min(smallest, sphere.radius);
  }
  return smallest;
}

/// An instance as seen from a camera.
struct SeenInstance {
  double away = 0;    // from the camera to the centre of its bounding sphere, at shutter opening
  double moves = 0;   // distance moved until the shutter closes
  double radius = 0;  // of its bounding sphere

  SeenInstance(const Instance& instance, const BoundingSphere& bounds, const CameraFrame& frame)
      : away(moderate_length(frame.place(instance.placement.apply(bounds.center)))),
        moves(moderate_length(frame.size(instance.shift))),
        radius(frame.size(bounds.radius * instance.placement.scale)) {}

  double extent() const { return away + moves + radius; }
};

}  // namespace

std::uint64_t count_spheres(const Scene& scene) noexcept {
  std::uint64_t count = scene.spheres.size();
  for (const Instance& instance : scene.instances) {
    const std::uint64_t more = scene.prototypes[instance.prototype].spheres.size();
    count += std::min(more, std::numeric_limits<std::uint64_t>::max() - count);
  }
  return count;
}

bool has_motion(const Scene& scene) noexcept {
  return !scene.shifts.empty() || std::ranges::any_of(scene.prototypes, [](const Prototype& of) {
    return !of.shifts.empty();
  }) || std::ranges::any_of(scene.instances, [](const Instance& of) { return of.shift != Vec3{}; });
}

Sphere placed(const Instance& instance, const Sphere& sphere) noexcept {
  return {.center = instance.placement.apply(sphere.center),
          .radius = sphere.radius * instance.placement.scale,
          .material = sphere.material};
}

Vec3 placed_shift(const Instance& instance, Vec3 shift) noexcept {
  return instance.placement.turn(shift) + instance.shift;
}

Scene without_instances(Scene scene) {
  const bool is_moving = has_motion(scene);
  if (is_moving) scene.shifts.resize(scene.spheres.size());
  for (const Instance& instance : scene.instances) {
    const Prototype& prototype = scene.prototypes[instance.prototype];
    for (std::size_t i = 0; i < prototype.spheres.size(); ++i) {
      scene.spheres.push_back(placed(instance, prototype.spheres[i]));
      if (!is_moving) continue;
      const Vec3 shift = prototype.shifts.empty() ? Vec3{} : prototype.shifts[i];
      scene.shifts.push_back(placed_shift(instance, shift));
    }
  }
  scene.prototypes.clear();
  scene.instances.clear();
  return scene;
}

InstanceExtremes extremes_of_instances(const Scene& scene, const CameraFrame& frame) {
  const InstanceExtremes none{.radius = kInfinity, .extent = 0, .distance = kInfinity};
  if (scene.instances.empty()) return none;
  const std::vector<BoundingSphere> all_bounds = bounding_spheres(scene.prototypes);
  std::vector<double> smallest;
  for (const Prototype& prototype : scene.prototypes) {
    smallest.push_back(smallest_radius(prototype));
  }
  const auto add = [&](InstanceExtremes& extremes, std::size_t i) {
    const Instance& instance = scene.instances[i];
    const SeenInstance seen(instance, all_bounds[instance.prototype], frame);
    const double min_radius = smallest[instance.prototype] * instance.placement.scale;
    extremes.radius = std::min(extremes.radius, frame.size(min_radius));
    extremes.extent = std::max(extremes.extent, seen.extent());
    if (seen.away - seen.moves > seen.radius) {
      extremes.distance = std::min(extremes.distance, seen.away - seen.moves - seen.radius);
    }
  };
  const auto join = [](InstanceExtremes& extremes, const InstanceExtremes& later) {
    extremes.radius = std::min(extremes.radius, later.radius);
    extremes.extent = std::max(extremes.extent, later.extent);
    extremes.distance = std::min(extremes.distance, later.distance);
  };
  InstanceExtremes extremes = reduce_indices(scene.instances.size(), none, add, join);

  std::size_t looks = 10'000'000;
  for (const Instance& instance : scene.instances) {
    const std::vector<Sphere>& spheres = scene.prototypes[instance.prototype].spheres;
    const SeenInstance seen(instance, all_bounds[instance.prototype], frame);
    if (seen.away > seen.radius || seen.moves > 0 || spheres.size() > looks) continue;
    looks -= spheres.size();
    for (const Sphere& sphere : spheres) {
      const Sphere there = placed(instance, sphere);
      const double of_sphere = frame.size(there.radius);
      const double to_surface = std::fabs(moderate_length(frame.place(there.center)) - of_sphere);
      if (to_surface <= kCoincidenceTolerance * of_sphere)
        continue;  // the camera is on its
                   // surface
      extremes.distance = std::min(extremes.distance, to_surface);
    }
  }
  return extremes;
}

double extent_of_instances(const Scene& scene, const CameraFrame& frame) {
  const std::vector<BoundingSphere> all_bounds = bounding_spheres(scene.prototypes);
  return largest_of(scene.instances.size(), 0, [&](std::size_t i) {
    const Instance& instance = scene.instances[i];
    return SeenInstance(instance, all_bounds[instance.prototype], frame).extent();
  });
}

std::vector<InstancedSphere> find_instanced_under_camera(const Scene& scene) {
  std::vector<InstancedSphere> found;
  if (scene.instances.empty()) return found;
  const Rebase rebase(scene);
  const std::vector<BoundingSphere> all_bounds = bounding_spheres(scene.prototypes);
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
    const Prototype& prototype = scene.prototypes[scene.instances[i].prototype];
    const BoundingSphere& bounds = all_bounds[scene.instances[i].prototype];
    // A moving sphere touches the camera only for an instant.
    if (scene.instances[i].shift != Vec3{}) continue;
    const Sphere around =
        rebase.sphere(placed(scene.instances[i], {bounds.center, bounds.radius, 0}));
    constexpr double kSlack = 1 + 0x1p-30;
    if (length(around.center) > around.radius * kSlack) continue;
    for (std::uint32_t k = 0; k < prototype.spheres.size(); ++k) {
      const Vec3 shift = prototype.shifts.empty() ? Vec3{} : prototype.shifts[k];
      const Sphere there = placed(scene.instances[i], prototype.spheres[k]);
      if (has_camera_on_it(rebase.sphere(there), shift)) found.push_back({i, k});
    }
  }
  return found;
}

}  // namespace sdlc::render
