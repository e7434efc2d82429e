#pragma once

#include <cstdint>

#include "render/math/vec3.hpp"
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

}  // namespace sdlc::render
