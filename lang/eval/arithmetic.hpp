#pragma once

#include "lang/ast/ast.hpp"
#include "lang/diagnostics/diagnostics.hpp"
#include "lang/eval/computed.hpp"

namespace sdlc::lang {

/// `left op right` for + - * /. `where` is the operator's place: what is wrong (types, units,
/// division by zero, a result beyond the largest number) is reported there.
Computed evaluate_operation(const Computed& left, Operator op, const Computed& right,
                            Location where, DiagnosticSink& sink);
Computed evaluate_power(const Computed& base, const Computed& exponent, Location where,
                        DiagnosticSink& sink);
Computed evaluate_negative(const Computed& operand, Location where, DiagnosticSink& sink);

}  // namespace sdlc::lang
