#pragma once

#include <string>

#include "lang/ast/ast.hpp"
#include "lang/diagnostics/diagnostics.hpp"
#include "lang/object/value.hpp"
#include "lang/schema/schema.hpp"

namespace sdlc::lang {

/// Adds a help or a fix to a report on a value of the wrong type. `written`: the expression of the
/// value.
void add_type_hint(DiagnosticBuilder& report, const Property& property, const Value& given,
                   ast::Node written);

/// The list of the whole numbers of the interval `a .. b`: `range(a, b + 1)`.
std::string as_range(ast::Node interval, const Bounds& bounds);

}  // namespace sdlc::lang
