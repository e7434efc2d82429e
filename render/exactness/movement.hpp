#pragma once

#include <algorithm>

#include "render/math/vec3.hpp"

namespace sdlc::render {

/// The time in [0, 1] at which a point that moves from `from` by `displacement` is nearest to the
/// origin; 0 if it does not move.
inline double nearest_moment(Vec3 from, Vec3 displacement) noexcept {
  const double squared = dot(displacement, displacement);
  return squared > 0 ? std::clamp(-dot(from, displacement) / squared, 0.0, 1.0) : 0;
}

}  // namespace sdlc::render
