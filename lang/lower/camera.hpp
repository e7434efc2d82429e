#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/lower/lowered_scene.hpp"
#include "lang/lower/settings.hpp"
#include "lang/object/object.hpp"
#include "lang/source/source.hpp"
#include "render/scene/scene.hpp"

namespace sdlc::lang {

/// A camera for the renderer, with what is written of it beside that.
struct LoweredCamera {
  render::Camera camera;
  WrittenCamera written;
};

/// The camera of a checked object; messages call its properties as `format` does. nullopt, once
/// reported, if it has no direction or no horizon (E207, E208), its view plane is too large (E214),
/// or a property is missing.
std::optional<LoweredCamera> lower_camera(const Object& object, SourceFormat format,
                                          DiagnosticSink& sink);

/// The camera that a flag or `render` names, else the only one. Null, once reported, if there is
/// none of that name or there are several; null, unreported, if there is none at all. `takes_any`:
/// of several the first will do.
const Object* choose_camera(const WantedSettings& wanted, std::span<const Object> cameras,
                            bool takes_any);

/// The name of a property in a format; the language's name if JSON has no key for it.
std::string_view property_name(const Object& object, std::size_t property, SourceFormat format);

}  // namespace sdlc::lang
