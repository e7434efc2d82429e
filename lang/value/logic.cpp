#include "lang/value/logic.hpp"

#include <optional>

namespace sdlc::lang {
namespace {

bool agree(Unit a, Unit b) noexcept { return a == b || a == Unit::None || b == Unit::None; }

std::optional<Unit> unit_of(const Computed& value) noexcept {
  if (const auto* scalar = std::get_if<Scalar>(&value)) return scalar->unit;
  if (const auto* triple = std::get_if<Triple>(&value)) return triple->unit;
  if (const auto* bounds = std::get_if<Bounds>(&value)) return bounds->unit;
  return std::nullopt;
}

/// Equality of two values of one alternative, lists left out.
struct Equal {
  bool operator()(Failed, Failed) const { return true; }
  bool operator()(Scalar a, Scalar b) const { return a.value == b.value; }
  bool operator()(Triple a, Triple b) const { return a.value == b.value; }
  bool operator()(AngleTriple a, AngleTriple b) const { return a.degrees == b.degrees; }
  bool operator()(Bounds a, Bounds b) const { return a.from == b.from && a.to == b.to; }
  template <typename T>
  bool operator()(const T& a, const T& b) const {
    return a == b;
  }
  template <typename A, typename B>
  bool operator()(const A&, const B&) const {
    return false;
  }
  bool operator()(const ListValue& a, const ListValue& b) const {
    if (a.size() != b.size()) return false;
    for (std::size_t i = 0; i < a.size(); ++i) {
      if (!are_equal(a[i], b[i]).value_or(false)) return false;
    }
    return true;
  }
};

template <typename T>
bool compare(const T& a, Operator op, const T& b) noexcept {
  switch (op) {
    case Operator::Less: return a < b;
    case Operator::LessEqual: return a <= b;
    case Operator::Greater: return a > b;
    default: return a >= b;
  }
}

std::string_view spelling(Operator op) noexcept {
  switch (op) {
    case Operator::Less: return "<";
    case Operator::LessEqual: return "<=";
    case Operator::Greater: return ">";
    default: return ">=";
  }
}

}  // namespace

bool are_of_one_type(const Computed& a, const Computed& b) noexcept {
  if (a.index() != b.index()) return false;
  const auto left = unit_of(a), right = unit_of(b);
  return !left || agree(*left, *right);
}

std::optional<bool> are_equal(const Computed& a, const Computed& b) {
  if (!are_of_one_type(a, b)) return std::nullopt;
  return std::visit(Equal(), a, b);
}

Computed evaluate_comparison(const Computed& left, Operator op, const Computed& right,
                             Location where, DiagnosticSink& sink) {
  if (has_failed(left) || has_failed(right)) return Failed{};
  if (op == Operator::Equal || op == Operator::NotEqual) {
    const std::optional<bool> equal = are_equal(left, right);
    if (equal) return *equal == (op == Operator::Equal);
    sink.report(diag::different_types, where, describe(left), describe(right));
    return Failed{};
  }
  if (are_of_one_type(left, right)) {
    if (const auto* a = std::get_if<Scalar>(&left)) {
      return compare(a->value, op, std::get<Scalar>(right).value);
    }
    if (const auto* a = std::get_if<Angle>(&left)) {
      return compare(a->degrees, op, std::get<Angle>(right).degrees);
    }
  }
  sink.report(diag::wrong_operands, where, spelling(op), describe(left), describe(right));
  return Failed{};
}

}  // namespace sdlc::lang
