#include "lang/lower/placement.hpp"

#include "lang/math/elementary.hpp"

namespace sdlc::lang {

render::Placement placement_of(render::Vec3 translate, render::Vec3 degrees,
                               double scale) noexcept {
  const double sx = sin_degrees(degrees.x), cx = cos_degrees(degrees.x);
  const double sy = sin_degrees(degrees.y), cy = cos_degrees(degrees.y);
  const double sz = sin_degrees(degrees.z), cz = cos_degrees(degrees.z);
  return {.x = render::Vec3{cz * cy, sz * cy, -sy} * scale,
          .y = render::Vec3{cz * sy * sx - sz * cx, sz * sy * sx + cz * cx, cy * sx} * scale,
          .z = render::Vec3{cz * sy * cx + sz * sx, sz * sy * cx - cz * sx, cy * cx} * scale,
          .translate = translate,
          .scale = scale};
}

}  // namespace sdlc::lang
