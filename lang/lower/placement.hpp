#pragma once

#include "render/math/vec3.hpp"

namespace sdlc::lang {

/// Where a group puts what is inside it: p' = translate + Rz Ry Rx (scale p), right-handed
/// (ruling 31).
struct Placement {
  render::Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};  ///< columns of scale times rotation
  render::Vec3 translate;
  double scale = 1;

  /// `degrees` about the x, then the y, then the z axis.
  static Placement of(render::Vec3 translate, render::Vec3 degrees, double scale) noexcept;

  render::Vec3 turn(render::Vec3 v) const noexcept { return x * v.x + y * v.y + z * v.z; }
  render::Vec3 apply(render::Vec3 p) const noexcept { return translate + turn(p); }
  /// This placement of what stands inside `inner`.
  Placement around(const Placement& inner) const noexcept;
};

}  // namespace sdlc::lang
