#include "render/exactness/instance_extremes.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "render/exactness/suspects.hpp"
#include "render/parallel/ranges.hpp"
#include "render/scene/bounding_sphere.hpp"
#include "render/scene/instances.hpp"

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

InstanceExtremes extremes_of_instances(const Scene& scene, const CameraFrame& frame,
                                       const LensDisc& lens) {
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
    extremes.extent = std::max(extremes.extent, seen.extent() + lens.radius());
    const double outside = seen.away - seen.moves - lens.radius();
    if (outside > seen.radius) {
      extremes.distance = std::min(extremes.distance, outside - seen.radius);
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
    if (seen.away - lens.radius() > seen.radius || seen.moves > 0 || spheres.size() > looks)
      continue;
    looks -= spheres.size();
    for (const Sphere& sphere : spheres) {
      const Sphere there = placed(instance, sphere);
      const double of_sphere = frame.size(there.radius);
      const Vec3 center = frame.place(there.center);
      const double to_surface = lens.radius() > 0 ? lens.clearance(center, {}, of_sphere)
                                                  : std::fabs(moderate_length(center) - of_sphere);
      // The camera is on its surface.
      if (to_surface <= kCoincidenceTolerance * of_sphere) continue;
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

}  // namespace sdlc::render
