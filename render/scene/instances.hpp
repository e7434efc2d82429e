#pragma once

#include <cstdint>
#include <vector>

#include "render/math/vec3.hpp"
#include "render/scene/rebase.hpp"
#include "render/scene/scene.hpp"

/// Functions for spheres that a scene stores as instances of prototypes.
namespace sdlc::render {

/// The number of spheres of a scene including those of instances; saturates at 2^64 - 1.
std::uint64_t count_spheres(const Scene& scene) noexcept;

/// Whether anything moves while the shutter is open.
bool has_motion(const Scene& scene) noexcept;

/// A sphere of the instance's prototype in world coordinates, at shutter opening.
Sphere placed(const Instance& instance, const Sphere& sphere) noexcept;
/// The displacement of a sphere of the instance that moves by `shift` in its prototype.
Vec3 placed_shift(const Instance& instance, Vec3 shift) noexcept;

/// The same scene with instances expanded into spheres. The caller must check the size first.
Scene without_instances(Scene scene);

/// The properties of a scene's instances that decide which precision resolves it; lengths in the
/// frame's unit.
struct InstanceExtremes {
  double radius;    ///< of the smallest sphere; infinite without instances
  double extent;    ///< upper bound of the distance from the camera to the farthest far side
  double distance;  ///< lower bound of the distance from the camera to the nearest surface: outside
                    ///< the bounding spheres of instances, the distance to these; inside those of
                    ///< static instances, the distance to their spheres at shutter opening
};
/// O(instances + spheres of prototypes) time, plus the spheres of instances whose bounding sphere
/// contains the camera, at most about 10^7.
InstanceExtremes extremes_of_instances(const Scene& scene, const CameraFrame& frame);

/// Only InstanceExtremes::extent. O(instances + spheres of prototypes) time.
double extent_of_instances(const Scene& scene, const CameraFrame& frame);

/// A sphere of an instance, by the index of each.
struct InstancedSphere {
  std::uint32_t instance = 0, sphere = 0;
};
/// The instanced spheres whose surface contains the camera, by the criterion of has_camera_on_it().
/// Visits all spheres of every instance whose bounding sphere contains the camera.
std::vector<InstancedSphere> find_instanced_under_camera(const Scene& scene);

}  // namespace sdlc::render
