#pragma once

#include <algorithm>

#include "render/math/vec3.hpp"

namespace sdlc::render {

/// When what goes from `from` along `way` while the shutter is open is nearest to the origin: from
/// 0 to 1, 0 where it stands still.
inline double nearest_moment(Vec3 from, Vec3 way) noexcept {
  const double squared = dot(way, way);
  return squared > 0 ? std::clamp(-dot(from, way) / squared, 0.0, 1.0) : 0;
}

}  // namespace sdlc::render
