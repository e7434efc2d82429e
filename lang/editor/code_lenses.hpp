#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lang/editor/scene_view.hpp"
#include "lang/source/source.hpp"

namespace sdlc::lang {

/// A line from which the scene can be rendered.
struct RenderLens {
  Span where;          ///< the camera's kind and name, or the first object's kind
  std::string camera;  ///< empty: the scene's only one
};

/// One per named camera of the file. Without named cameras, one at the first camera, sphere, group,
/// instance, loop, condition or include of the top level. A file that only declares has none.
std::vector<RenderLens> render_lenses(const SceneView& view, std::uint32_t file);

}  // namespace sdlc::lang
