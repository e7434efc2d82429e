#pragma once

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/object/object.hpp"
#include "render/scene/scene.hpp"

namespace sdlc::lang {

/// Sets `background` to that of a checked `background` object: one colour, or a gradient. Reports
/// missing and contradictory properties, and then leaves `background` unchanged.
void lower_background(const Object& object, DiagnosticSink& sink, render::Background& background);

}  // namespace sdlc::lang
