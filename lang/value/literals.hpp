#pragma once

#include <string>

#include "lang/ast/ast.hpp"
#include "lang/diagnostics/diagnostics.hpp"
#include "lang/value/computed.hpp"

namespace sdlc::lang {

/// A Number: correctly rounded, then divided or multiplied once by its unit. Reports what is too
/// large.
Computed evaluate_number(ast::Node node, DiagnosticSink& sink);
/// A String without its quotes and escapes. Reports halves of surrogate pairs.
Computed evaluate_string(ast::Node node, DiagnosticSink& sink);

}  // namespace sdlc::lang
