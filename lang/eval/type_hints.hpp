#pragma once

#include "lang/ast/ast.hpp"
#include "lang/diagnostics/diagnostics.hpp"
#include "lang/schema/schema.hpp"
#include "lang/value/computed.hpp"

namespace sdlc::lang {

/// Adds to a report of a value of the wrong type what to write instead. `written` is where the
/// value stands.
void add_type_hint(DiagnosticBuilder& report, const Property& property, const Computed& given,
                   ast::Node written);

}  // namespace sdlc::lang
