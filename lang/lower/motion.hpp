#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/object/object.hpp"
#include "render/math/interval.hpp"
#include "render/math/placement.hpp"
#include "render/math/vec3.hpp"
#include "render/scene/scene.hpp"

namespace sdlc::lang {

/// A sphere with a `motion`, whose path depends on the shutter.
struct MovingSphere {
  std::uint32_t sphere;  ///< index in the scene
  Location where;        ///< of the motion in the text
  MotionValue motion;
  render::Vec3 center;  ///< at motion.over.from, inside the groups
  /// The groups around it, at the opening and the closing of the shutter; nullopt: none.
  std::optional<std::array<render::Placement, 2>> groups;
};

/// The centre of a sphere with this motion, which is at `center` at motion.over.from, inside its
/// groups.
render::Vec3 center_at(const MotionValue& motion, render::Vec3 center, double time) noexcept;

/// Moves the spheres to their positions at the opening of the shutter, and sets their shifts until
/// the closing; `shifts` has the size of `spheres`. Reports paths beyond the range of double.
void lower_motion(std::span<const MovingSphere> moving, render::Interval shutter,
                  DiagnosticSink& sink, std::vector<render::Sphere>& spheres,
                  std::vector<render::Vec3>& shifts);

}  // namespace sdlc::lang
