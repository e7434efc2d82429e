#pragma once

#include "lang/ast/ast.hpp"
#include "lang/diagnostics/diagnostics.hpp"
#include "lang/value/computed.hpp"

namespace sdlc::lang {

/// An operator between two operands. Its place in the text is searched only when it is asked for.
struct OperatorPlace {
  ast::Node left, right;

  Location location() const;
};

/// `left op right` for + - * /. What is wrong (types, units, division by zero, a result beyond the
/// largest number) is reported at the operator.
Computed evaluate_operation(const Computed& left, Operator op, const Computed& right,
                            const OperatorPlace& where, DiagnosticSink& sink);
Computed evaluate_power(const Computed& base, const Computed& exponent, const OperatorPlace& where,
                        DiagnosticSink& sink);
Computed evaluate_negative(const Computed& operand, Location where, DiagnosticSink& sink);

}  // namespace sdlc::lang
