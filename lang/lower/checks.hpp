#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/lower/group_contents.hpp"
#include "lang/lower/lowered_scene.hpp"
#include "lang/lower/settings.hpp"
#include "lang/object/object.hpp"
#include "lang/source/source.hpp"
#include "render/math/placement.hpp"
#include "render/math/vec3.hpp"
#include "render/scene/coincident.hpp"

// What checks of a text need beside the scene.
namespace sdlc::lang {

/// All cameras; what is wrong with one is reported.
std::vector<CheckedCamera> check_cameras(std::span<const Object> cameras, SourceFormat format,
                                         DiagnosticSink& sink);

/// Where the text sets what checks may complain about. `background` may be null.
WrittenPlaces find_places(const WantedSettings& wanted, const Object* background);

/// How a group moves between the opening and the closing of the shutter.
struct GroupPath {
  render::Placement halfway;
  bool is_turning = false;

  /// The path of a group inside this one, whose own is `inner`.
  GroupPath around(const GroupPath& inner) const;
};

/// How far a centre that is at `opening` and `closing` in the group is from the midpoint of its
/// straight path half-way.
double sagitta_of(const Placing& group, const GroupPath& path, render::Vec3 opening,
                  render::Vec3 closing);

/// Gives the paths the indices that their spheres have once `dropped`, in order, are removed, and
/// erases those of removed spheres.
void renumber(std::span<const render::CoincidentSphere> dropped, std::vector<BentPath>& paths);

}  // namespace sdlc::lang
