#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/lower/lowered_scene.hpp"
#include "lang/lower/named_spheres.hpp"
#include "lang/lower/settings.hpp"
#include "lang/object/object.hpp"
#include "lang/source/source.hpp"
#include "render/scene/scene.hpp"

namespace sdlc::lang {

/// A camera for the renderer, and its settings as written.
struct LoweredCamera {
  render::Camera camera;
  WrittenCamera written;
};

/// Lowers a checked camera, which may focus on one of `names`; messages use the property names of
/// `format`. Reports and returns nullopt if it has no view direction or no horizon (E207, E208),
/// its view plane is too large (E214), lower_lens() fails, or a property is missing.
std::optional<LoweredCamera> lower_camera(const Object& object, SourceFormat format,
                                          const NamedSpheres& names, DiagnosticSink& sink);

/// The camera that a flag or `render` names, otherwise the only one. Reports and returns null if
/// the named one does not exist, or if there are several and none is named; with `takes_any` the
/// first one is chosen instead. Without any camera, returns null and reports nothing.
const Object* choose_camera(const WantedSettings& wanted, std::span<const Object> cameras,
                            bool takes_any);

/// Without a file if the property is not written.
Location written_location(const Object& object, std::size_t property);

/// The name of a property in the format; that of the language if JSON has no key for it.
std::string_view property_name(const Object& object, std::size_t property, SourceFormat format);

}  // namespace sdlc::lang
