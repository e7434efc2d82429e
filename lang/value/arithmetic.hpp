#pragma once

#include <string_view>

#include "lang/ast/ast.hpp"
#include "lang/diagnostics/diagnostics.hpp"
#include "lang/object/value.hpp"

namespace sdlc::lang {

/// The place of an operator between two operands. The text is searched only for location().
struct OperatorPlace {
  ast::Node left, right;

  Location location() const;
};

/// Whether all components of the value are finite; true for values that are not numeric.
bool is_finite(const Value& value) noexcept;

/// The operator as the language spells it; empty for Operator::None.
std::string_view spelling(Operator op) noexcept;

/// `left op right` for + - * /. Errors (types, units, division by zero, overflow) are reported at
/// the operator; the result is then Nothing. Nothing in gives Nothing out, silently.
Value evaluate_operation(const Value& left, Operator op, const Value& right,
                         const OperatorPlace& where, DiagnosticSink& sink);
/// base ^ exponent: see raise() of elementary.hpp.
Value evaluate_power(const Value& base, const Value& exponent, const OperatorPlace& where,
                     DiagnosticSink& sink);
Value evaluate_negative(const Value& operand, Location where, DiagnosticSink& sink);

}  // namespace sdlc::lang
