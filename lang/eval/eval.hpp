#pragma once

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/object/object.hpp"
#include "lang/syntax/syntax.hpp"

namespace sdlc::lang {

/// Evaluates a file: every object goes to `objects`, in the order of the file, its properties
/// checked; what is wrong is reported. An object with a mistake in it is passed too, with what is
/// right of it.
void evaluate(const SyntaxTree& tree, ObjectSink& objects, DiagnosticSink& sink);

}  // namespace sdlc::lang
