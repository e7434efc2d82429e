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

/// A sphere with a `motion`: its path is known only once the shutter is.
struct MovingSphere {
  std::uint32_t sphere;  ///< index in the scene
  Location where;        ///< of the motion in the text
  MotionValue motion;
  render::Vec3 center;  ///< at motion.over.from, inside the groups
  /// The groups around it, at the opening and the closing of the shutter; nullopt: none.
  std::optional<std::array<render::Placement, 2>> groups;
};

/// Puts the spheres where they are when the shutter opens, and adds how far they move until it
/// closes to `shifts`, which is as long as `spheres`. Reports a path beyond the range of double.
void lower_motion(std::span<const MovingSphere> moving, render::Interval shutter,
                  DiagnosticSink& sink, std::vector<render::Sphere>& spheres,
                  std::vector<render::Vec3>& shifts);

}  // namespace sdlc::lang
