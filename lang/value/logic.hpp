#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "lang/ast/ast.hpp"
#include "lang/diagnostics/diagnostics.hpp"
#include "lang/object/value.hpp"

namespace sdlc::lang {

/// Whether numbers of these units add up: a number without a unit takes the other's.
constexpr bool are_compatible(Unit a, Unit b) noexcept {
  return a == b || a == Unit::None || b == Unit::None;
}
/// The unit of their sum.
constexpr Unit common_unit(Unit a, Unit b) noexcept { return a == Unit::None ? b : a; }

/// Whether two values are equal (-0 is 0); nullopt if their types or units differ.
std::optional<bool> are_equal(const Value& a, const Value& b);

/// `left op right` for == != < <= > >=. Values that cannot be compared are reported at `where`; the
/// result is then Nothing.
Value evaluate_comparison(const Value& left, Operator op, const Value& right, Location where,
                          DiagnosticSink& sink);

/// Whether two values can be elements of one list: the same type, and compatible units. Rows are of
/// one type if they have as many elements and each has the type of its place. Takes time in
/// proportion to the weight of a row.
bool are_of_one_type(const Value& a, const Value& b);

/// The first place where the types of two rows differ; the length of the shorter if one lacks
/// elements; nullopt if they are of one type.
std::optional<std::size_t> first_difference(const ListValue& a, const ListValue& b);

/// How two rows of different types differ, as in "the rows have 2 and 3 elements".
std::string describe_difference(const ListValue& a, const ListValue& b);

/// Reports a row where a list is needed: it mixes two types.
void report_mixed(const RowValue& row, Location where, DiagnosticSink& sink);

}  // namespace sdlc::lang
