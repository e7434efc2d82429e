#pragma once

#include <cstdint>
#include <string>

#include "lang/ast/ast.hpp"
#include "lang/diagnostics/diagnostics.hpp"
#include "lang/object/value.hpp"
#include "lang/source/limits.hpp"
#include "lang/source/source.hpp"

namespace sdlc::lang {

/// A Number: correctly rounded, then divided or multiplied once by its unit. Reports what is too
/// large.
Value evaluate_number(ast::Node node, DiagnosticSink& sink);
/// A String without its quotes and escapes. Reports halves of surrogate pairs.
Value evaluate_string(ast::Node node, DiagnosticSink& sink);

/// Whether a string may be this long; if not, that is reported at `where`.
bool check_string_size(std::uint64_t bytes, const Limits& limits, Location where,
                       DiagnosticSink& sink);

}  // namespace sdlc::lang
