#pragma once

#include <optional>

#include "lang/ast/ast.hpp"
#include "lang/diagnostics/diagnostics.hpp"
#include "lang/value/computed.hpp"

namespace sdlc::lang {

/// Whether two values are the same to the bit (-0 is 0); nothing where their types differ, units
/// included.
std::optional<bool> are_equal(const Computed& a, const Computed& b);

/// `left op right` for == != < <= > >=. What cannot be compared is reported at `where`.
Computed evaluate_comparison(const Computed& left, Operator op, const Computed& right,
                             Location where, DiagnosticSink& sink);

/// Whether a value can stand in a list beside another: the same type, and units that add up.
bool are_of_one_type(const Computed& a, const Computed& b) noexcept;

}  // namespace sdlc::lang
