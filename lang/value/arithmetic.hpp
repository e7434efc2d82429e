#pragma once

#include "lang/ast/ast.hpp"
#include "lang/diagnostics/diagnostics.hpp"
#include "lang/object/value.hpp"

namespace sdlc::lang {

/// An operator between two operands. Its place in the text is searched only when it is asked for.
struct OperatorPlace {
  ast::Node left, right;

  Location location() const;
};

/// `left op right` for + - * /. What is wrong (types, units, division by zero, a result beyond the
/// largest number) is reported at the operator.
Value evaluate_operation(const Value& left, Operator op, const Value& right,
                         const OperatorPlace& where, DiagnosticSink& sink);
Value evaluate_power(const Value& base, const Value& exponent, const OperatorPlace& where,
                     DiagnosticSink& sink);
Value evaluate_negative(const Value& operand, Location where, DiagnosticSink& sink);

}  // namespace sdlc::lang
