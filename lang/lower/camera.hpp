#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/lower/scene_builder.hpp"
#include "lang/object/object.hpp"
#include "lang/source/source.hpp"
#include "render/scene/scene.hpp"

namespace sdlc::lang {

/// A camera as the renderer has it, and what of its text is not in that.
struct LoweredCamera {
  render::Camera camera;
  WrittenCamera written;
};

/// The camera of a checked object, named in messages as `format` names its properties; nothing
/// where it looks nowhere or has no horizon (E207, E208), where its view plane is too large (E214)
/// or what it needs is absent, which has been reported.
std::optional<LoweredCamera> lower_camera(const Object& object, SourceFormat format,
                                          DiagnosticSink& sink);

/// What files of a format call a property; where JSON has no key for it, what the language does.
std::string_view property_name(const Object& object, std::size_t property, SourceFormat format);

}  // namespace sdlc::lang
