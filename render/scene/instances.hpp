#pragma once

#include <cstdint>
#include <vector>

#include "render/math/vec3.hpp"
#include "render/scene/rebase.hpp"
#include "render/scene/scene.hpp"

/// Spheres that a scene holds as instances of prototypes.
namespace sdlc::render {

/// Of a scene, those of instances among them; 2^64 - 1 where there are more.
std::uint64_t count_spheres(const Scene& scene) noexcept;

/// Whether anything moves while the shutter is open.
bool has_motion(const Scene& scene) noexcept;

/// A sphere of the instance's prototype where the instance puts it, at the opening of the shutter.
Sphere placed(const Instance& instance, const Sphere& sphere) noexcept;
/// How far such a sphere moves that moves by `shift` in its prototype.
Vec3 placed_shift(const Instance& instance, Vec3 shift) noexcept;

/// The same scene with every sphere of its own. For comparison: what can be held so, may be.
Scene without_instances(Scene scene);

/// What of a scene's instances decides which precision resolves it; lengths in the frame's unit.
struct InstanceExtremes {
  double radius;    ///< of the smallest sphere; infinite without instances
  double extent;    ///< at least the distance from the camera to the far side of the farthest one
  double distance;  ///< from the camera to the nearest surface: at most, from outside the balls
                    ///< around instances; in those that stand still, that of spheres at opening
};
/// O(instances + spheres of prototypes) time, and the spheres of instances whose ball the camera is
/// in, some 10^7 of them at most.
InstanceExtremes extremes_of_instances(const Scene& scene, const CameraFrame& frame);

/// InstanceExtremes::extent alone. O(instances + spheres of prototypes) time.
double extent_of_instances(const Scene& scene, const CameraFrame& frame);

/// A sphere of an instance, by the index of each.
struct InstancedSphere {
  std::uint32_t instance = 0, sphere = 0;
};
/// Those on whose surface the camera of a scene stands, as has_camera_on_it() says of others. The
/// spheres of each instance whose ball the camera is in are looked at.
std::vector<InstancedSphere> find_instanced_under_camera(const Scene& scene);

}  // namespace sdlc::render
