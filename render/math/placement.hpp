#pragma once

#include "render/math/vec3.hpp"

namespace sdlc::render {

/// The transformation of a group: p' = translate + scale · (rotation of p), a similarity that
/// preserves orientation.
struct Placement {
  Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};  ///< columns of scale times rotation
  Vec3 translate;
  double scale = 1;

  constexpr Vec3 turn(Vec3 v) const noexcept { return x * v.x + y * v.y + z * v.z; }
  constexpr Vec3 apply(Vec3 p) const noexcept { return translate + turn(p); }
  /// Composition: this placement applied after `inner`.
  constexpr Placement around(const Placement& inner) const noexcept {
    return {.x = turn(inner.x),
            .y = turn(inner.y),
            .z = turn(inner.z),
            .translate = apply(inner.translate),
            .scale = scale * inner.scale};
  }

  friend constexpr bool operator==(const Placement&, const Placement&) = default;
};

}  // namespace sdlc::render
