#pragma once

#include <span>

#include "lang/compile/compile.hpp"
#include "lang/diagnostics/diagnostics.hpp"
#include "lang/workspace/document.hpp"

namespace sdlc::lang {

/// Reports errors and warnings as Compiler::check() does, then, if there are no errors, the
/// findings of all rules, and last the allowances that are not needed. `file` and `sink` are those
/// of the compiler, which must be new.
void lint(Compiler& compiler, const Document& file, DiagnosticSink& sink);

}  // namespace sdlc::lang
