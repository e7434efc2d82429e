#pragma once

#include "render/math/vec3.hpp"

namespace sdlc::test::reference {

using namespace render;  // NOLINT

/// A half-line. `direction` has length 1; `u` is the time within the shutter, from 0 (opening) to 1
/// (closing).
struct Ray {
  Vec3 origin;
  Vec3 direction;
  double u = 0;
};

}  // namespace sdlc::test::reference
