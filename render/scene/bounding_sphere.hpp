#pragma once

#include <vector>

#include "render/math/vec3.hpp"
#include "render/scene/scene.hpp"

namespace sdlc::render {

/// The bounding sphere of all spheres of a prototype, over the whole shutter.
struct BoundingSphere {
  Vec3 center;
  double radius = 0;
};
BoundingSphere bounding_sphere(const Prototype& prototype) noexcept;
std::vector<BoundingSphere> bounding_spheres(const std::vector<Prototype>& prototypes);

}  // namespace sdlc::render
