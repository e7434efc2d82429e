#pragma once

#include <optional>

#include "lang/ast/ast.hpp"
#include "lang/diagnostics/diagnostics.hpp"
#include "lang/object/value.hpp"

namespace sdlc::lang {

/// Whether two values are equal (-0 is 0); nullopt if their types or units differ.
std::optional<bool> are_equal(const Value& a, const Value& b);

/// `left op right` for == != < <= > >=. What cannot be compared is reported at `where`.
Value evaluate_comparison(const Value& left, Operator op, const Value& right, Location where,
                          DiagnosticSink& sink);

/// Whether two values can be elements of one list: the same type, and units that add up.
bool are_of_one_type(const Value& a, const Value& b) noexcept;

}  // namespace sdlc::lang
