#include "lang/value/logic.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "lang/value/arithmetic.hpp"
#include "lang/value/element_type.hpp"

namespace sdlc::lang {
namespace {

bool are_lists_equal(const ListValue& a, const ListValue& b);

/// Equality of two values of one alternative.
struct Equal {
  bool operator()(Nothing, Nothing) const { return true; }
  bool operator()(Scalar a, Scalar b) const { return a.value == b.value; }
  bool operator()(Triple a, Triple b) const { return a.value == b.value; }
  bool operator()(AngleTriple a, AngleTriple b) const { return a.degrees == b.degrees; }
  bool operator()(Bounds a, Bounds b) const { return a.from == b.from && a.to == b.to; }
  template <typename T>
  bool operator()(const T& a, const T& b) const {
    return a == b;
  }
  bool operator()(const ListValue& a, const ListValue& b) const { return are_lists_equal(a, b); }
  bool operator()(const RowValue& a, const RowValue& b) const {
    return are_lists_equal(a.elements, b.elements);
  }
};

/// A loop instead of recursion: lists may be nested as deeply as the file is long.
bool are_lists_equal(const ListValue& a, const ListValue& b) {
  std::vector<std::pair<ListValue, ListValue>> waiting{{a, b}};
  while (!waiting.empty()) {
    const auto [left, right] = std::move(waiting.back());
    waiting.pop_back();
    if (left.size() != right.size()) return false;
    for (std::size_t i = 0; i < left.size(); ++i) {
      const Value x = left[i], y = right[i];
      const ListValue *inner = elements_of(x), *other = elements_of(y);
      if (inner != nullptr && other != nullptr && x.index() == y.index()) {
        waiting.emplace_back(*inner, *other);
      } else if (!are_equal(x, y).value_or(false)) {
        return false;
      }
    }
  }
  return true;
}

template <typename T>
bool compare(const T& a, Operator op, const T& b) noexcept {
  switch (op) {
    case Operator::Less: return a < b;
    case Operator::LessEqual: return a <= b;
    case Operator::Greater: return a > b;
    default: return a >= b;
  }
}

}  // namespace

Unit unit_of(const Value& value) noexcept {
  if (const auto* scalar = get_if<Scalar>(&value)) return scalar->unit;
  if (const auto* triple = get_if<Triple>(&value)) return triple->unit;
  if (const auto* bounds = get_if<Bounds>(&value)) return bounds->unit;
  return Unit::None;
}

bool are_alike(const Value& a, const Value& b) noexcept {
  return a.index() == b.index() && are_compatible(unit_of(a), unit_of(b));
}

bool are_of_one_type(const Value& a, const Value& b) {
  if (!are_alike(a, b)) return false;
  if (!holds_alternative<RowValue>(a)) return true;
  ElementType type;
  return type.admit(a) && type.admit(b);
}

std::optional<std::size_t> first_difference(const ListValue& a, const ListValue& b) {
  const std::size_t size = std::min(a.size(), b.size());
  for (std::size_t i = 0; i < size; ++i) {
    if (!are_of_one_type(a[i], b[i])) return i;
  }
  return a.size() == b.size() ? std::nullopt : std::optional(size);
}

std::optional<std::pair<std::size_t, std::size_t>> first_conflict(const ListValue& values) {
  ElementType type;
  for (std::size_t k = 0; k < values.size(); ++k) {
    const Value value = values[k];
    if (type.admit(value)) continue;
    std::size_t i = 0;
    while (are_of_one_type(values[i], value)) ++i;
    return std::pair(i, k);
  }
  return std::nullopt;
}

void report_mixed(const RowValue& row, Location where, DiagnosticSink& sink) {
  const auto [i, k] = *first_conflict(row.elements);
  sink.report(diag::mixed_list, where, describe(row.elements[i]), describe(row.elements[k]))
      .help("a list of several types is a row; its elements are used one by one: `row[0]`");
}

std::optional<bool> are_equal(const Value& a, const Value& b) {
  if (!are_of_one_type(a, b)) return std::nullopt;
  return visit([&]<typename T>(const T& value) { return Equal()(value, get<T>(b)); }, a);
}

std::string describe_difference(const ListValue& a, const ListValue& b) {
  if (a.size() != b.size()) {
    return fmt::format("the rows have {} and {} elements", a.size(), b.size());
  }
  const std::size_t i = first_difference(a, b).value_or(0);
  return fmt::format("element {} is {} in the first row and {} in the second", i, describe(a[i]),
                     describe(b[i]));
}

Value evaluate_comparison(const Value& left, Operator op, const Value& right, Location where,
                          DiagnosticSink& sink) {
  if (is_nothing(left) || is_nothing(right)) return Nothing{};
  if (op == Operator::Equal || op == Operator::NotEqual) {
    const std::optional<bool> equal = are_equal(left, right);
    if (equal) return *equal == (op == Operator::Equal);
    auto report = sink.report(diag::different_types, where, describe(left), describe(right));
    const auto *a = get_if<RowValue>(&left), *b = get_if<RowValue>(&right);
    if (a != nullptr && b != nullptr) report.help(describe_difference(a->elements, b->elements));
    return Nothing{};
  }
  if (are_of_one_type(left, right)) {
    if (const auto* a = get_if<Scalar>(&left)) {
      return compare(a->value, op, get<Scalar>(right).value);
    }
    if (const auto* a = get_if<Angle>(&left)) {
      return compare(a->degrees, op, get<Angle>(right).degrees);
    }
  }
  sink.report(diag::wrong_operands, where, spelling(op), describe(left), describe(right));
  return Nothing{};
}

}  // namespace sdlc::lang
