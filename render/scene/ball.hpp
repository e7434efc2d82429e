#pragma once

#include <vector>

#include "render/math/vec3.hpp"
#include "render/scene/scene.hpp"

namespace sdlc::render {

/// A ball around all spheres of a prototype, over the whole shutter.
struct Ball {
  Vec3 center;
  double radius = 0;
};
Ball ball_around(const Prototype& prototype) noexcept;
std::vector<Ball> balls_around(const std::vector<Prototype>& prototypes);

}  // namespace sdlc::render
