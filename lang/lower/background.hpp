#pragma once

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/object/object.hpp"
#include "render/scene/scene.hpp"

namespace sdlc::lang {

/// Sets the background that a checked `background` describes: one colour, or a gradient. What is
/// missing or too much is reported, and leaves `background` as it is.
void lower_background(const Object& object, DiagnosticSink& sink, render::Background& background);

}  // namespace sdlc::lang
