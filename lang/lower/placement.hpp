#pragma once

#include "render/math/placement.hpp"
#include "render/math/vec3.hpp"

namespace sdlc::lang {

/// The placement p' = translate + Rz Ry Rx (scale p), right-handed, with rotations by
/// `degrees` about the x, then the y, then the z axis.
render::Placement placement_of(render::Vec3 translate, render::Vec3 degrees, double scale) noexcept;

}  // namespace sdlc::lang
