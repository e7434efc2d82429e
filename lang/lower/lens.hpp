#pragma once

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/lower/named_spheres.hpp"
#include "lang/object/object.hpp"
#include "render/scene/scene.hpp"

namespace sdlc::lang {

/// Sets the lens of `camera`, whose view is valid, from the properties of `object`. Reports and
/// returns false if no sphere or several have the name in `focus` (E124, E125), the plane in focus
/// is not in front of the camera (E240), a number is beyond the range of double (E214), or a
/// property is invalid.
bool lower_lens(const Object& object, const NamedSpheres& names, DiagnosticSink& sink,
                render::Camera& camera);

}  // namespace sdlc::lang
