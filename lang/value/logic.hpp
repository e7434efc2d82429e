#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>

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

/// That of a number, vector or interval; None of other values.
Unit unit_of(const Value& value) noexcept;

/// Whether two values are equal (-0 is 0); nullopt if their types or units differ.
std::optional<bool> are_equal(const Value& a, const Value& b);

/// `left op right` for == != < <= > >=. Values that cannot be compared are reported at `where`; the
/// result is then Nothing.
Value evaluate_comparison(const Value& left, Operator op, const Value& right, Location where,
                          DiagnosticSink& sink);

/// Whether two values are of one type, apart from the elements of rows: units are compatible.
bool are_alike(const Value& a, const Value& b) noexcept;

/// Whether two values can be the elements of a list (see ElementType for more): the same type, and
/// compatible units. Rows are of one type if they have as many elements and each has the type of
/// its place. Takes time in proportion to the weight of a row.
bool are_of_one_type(const Value& a, const Value& b);

/// The first place where the types of two rows differ; the length of the shorter if one lacks
/// elements; nullopt if they are of one type.
std::optional<std::size_t> first_difference(const ListValue& a, const ListValue& b);

/// The first two elements, in this order, that cannot be in one list; nullopt if there are none.
std::optional<std::pair<std::size_t, std::size_t>> first_conflict(const ListValue& values);

/// How two rows of different types differ, as in "the rows have 2 and 3 elements".
std::string describe_difference(const ListValue& a, const ListValue& b);

/// Reports a row where a list is needed: it mixes two types.
void report_mixed(const RowValue& row, Location where, DiagnosticSink& sink);

}  // namespace sdlc::lang
