#pragma once

#include <span>

#include "lang/compile/compile.hpp"
#include "lang/diagnostics/diagnostics.hpp"
#include "lang/workspace/document.hpp"

namespace sdlc::lang {

/// Reports what is wrong with the text, as Compiler::check() does, and if there are no errors, what
/// is right and yet probably not what was meant; last of all, what comments allow without need.
/// `file` and `sink` are those of the compiler, which has done nothing else before.
void lint(Compiler& compiler, const Document& file, DiagnosticSink& sink);

}  // namespace sdlc::lang
