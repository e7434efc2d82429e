#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/lower/group_contents.hpp"
#include "lang/lower/lowered_scene.hpp"
#include "lang/lower/named_spheres.hpp"
#include "lang/lower/settings.hpp"
#include "lang/object/object.hpp"
#include "lang/source/source.hpp"
#include "render/exactness/coincident.hpp"
#include "render/math/placement.hpp"
#include "render/math/vec3.hpp"

// Data about a scene that is only computed for checks.
namespace sdlc::lang {

/// Lowers all cameras, reports mistakes, and returns the valid ones.
std::vector<CheckedCamera> check_cameras(std::span<const Object> cameras, SourceFormat format,
                                         const NamedSpheres& names, DiagnosticSink& sink);

/// The places of the settings that checks report. `background` may be null.
WrittenPlaces find_places(const WantedSettings& wanted, const Object* background);

/// How a group moves between the opening and the closing of the shutter.
struct GroupPath {
  render::Placement halfway;
  bool is_turning = false;

  /// The path of a group inside this one, whose own is `inner`.
  GroupPath around(const GroupPath& inner) const;
};

/// The half-way error of the straight path of a centre, which is at `opening` and `closing` in the
/// group: the distance of its midpoint from the true path.
double sagitta_of(const Placing& group, const GroupPath& path, render::Vec3 opening,
                  render::Vec3 closing);

/// Updates the indices of the paths for the removal of the spheres `dropped`, which are ascending,
/// and erases the paths of removed spheres.
void renumber(std::span<const render::CoincidentSphere> dropped, std::vector<BentPath>& paths);

}  // namespace sdlc::lang
