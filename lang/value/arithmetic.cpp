#include "lang/value/arithmetic.hpp"

#include <cmath>
#include <optional>

#include "lang/math/elementary.hpp"
#include "lang/value/logic.hpp"

namespace sdlc::lang {
namespace {

using render::LinearRgb;
using render::Vec3;

/// Applies `function` to the number, vector or colour of the value, and `unit_of` to its unit.
/// Nothing if values of its type are not computed with.
template <typename Function, typename UnitFunction>
Value mapped(const Value& value, Function function, UnitFunction unit_of) {
  if (const auto* scalar = get_if<Scalar>(&value)) {
    return Scalar{function(scalar->value), unit_of(scalar->unit)};
  }
  if (const auto* triple = get_if<Triple>(&value)) {
    return Triple{function(triple->value), unit_of(triple->unit)};
  }
  if (const auto* angle = get_if<Angle>(&value)) return Angle{function(angle->degrees)};
  if (const auto* angles = get_if<AngleTriple>(&value)) {
    return AngleTriple{function(angles->degrees)};
  }
  if (const auto* color = get_if<LinearRgb>(&value)) return function(*color);
  return Nothing{};
}

class Operation {
 public:
  Operation(const Value& left, Operator op, const Value& right, const OperatorPlace& where,
            DiagnosticSink& sink)
      : left_(left), op_(op), right_(right), where_(where), sink_(sink) {}

  Value run() {
    if (is_nothing(left_) || is_nothing(right_)) return Nothing{};
    const Value result = op_ == Operator::Add || op_ == Operator::Subtract ? sum()
                         : op_ == Operator::Multiply                       ? product()
                                                                           : quotient();
    if (is_finite(result)) return result;
    sink_.report(diag::overflow, where_.location(), spelling(op_));
    return Nothing{};
  }

 private:
  template <typename T>
  const T* left() const noexcept {
    return get_if<T>(&left_);
  }
  template <typename T>
  const T* right() const noexcept {
    return get_if<T>(&right_);
  }

  Value wrong_types() {
    auto report = sink_.report(diag::wrong_operands, where_.location(), spelling(op_),
                               describe(left_), describe(right_));
    const bool has_string = left<std::string>() != nullptr || right<std::string>() != nullptr;
    const bool has_list = left<ListValue>() != nullptr || right<ListValue>() != nullptr;
    if (has_string && op_ == Operator::Add) report.help("convert the other value by `str(…)`");
    const bool may_join = op_ == Operator::Add && !left<Triple>() && !right<Triple>();
    if (has_list && may_join) report.help("`+` joins two lists: `list + [x]`");
    if (has_list && !may_join) report.help("a point is written in parentheses: `(x, y, z)`");
    return Nothing{};
  }

  template <typename T>
  T add(T a, T b) const noexcept {
    return op_ == Operator::Add ? a + b : a - b;
  }

  template <typename T>
  Value sum_with_unit(const T& a, const T& b) {
    if (!are_compatible(a.unit, b.unit)) return wrong_types();
    return T{add(a.value, b.value), common_unit(a.unit, b.unit)};
  }

  Value sum() {
    if (left<Scalar>() && right<Scalar>()) return sum_with_unit(*left<Scalar>(), *right<Scalar>());
    if (left<Triple>() && right<Triple>()) return sum_with_unit(*left<Triple>(), *right<Triple>());
    if (left<Angle>() && right<Angle>()) {
      return Angle{add(left<Angle>()->degrees, right<Angle>()->degrees)};
    }
    if (left<AngleTriple>() && right<AngleTriple>()) {
      return AngleTriple{add(left<AngleTriple>()->degrees, right<AngleTriple>()->degrees)};
    }
    if (left<LinearRgb>() && right<LinearRgb>())
      return add(*left<LinearRgb>(), *right<LinearRgb>());
    return wrong_types();
  }

  Value product() {
    if (left<LinearRgb>() && right<LinearRgb>()) return *left<LinearRgb>() * *right<LinearRgb>();
    const Scalar* factor = right<Scalar>() ? right<Scalar>() : left<Scalar>();
    if (!factor) return wrong_types();
    // A product of two units has none.
    const auto unit_of = [&](Unit unit) {
      return unit == Unit::None ? factor->unit : factor->unit == Unit::None ? unit : Unit::None;
    };
    const Value& other = right<Scalar>() ? left_ : right_;
    const Value result = mapped(
        other, [&](auto x) { return x * factor->value; }, unit_of);
    return is_nothing(result) ? wrong_types() : result;
  }

  Value division_by_zero() {
    sink_.report(diag::division_by_zero, where_.location());
    return Nothing{};
  }

  Value quotient() {
    if (left<Angle>() && right<Angle>()) {
      const double divisor = right<Angle>()->degrees;
      return divisor == 0 ? division_by_zero() : Scalar{left<Angle>()->degrees / divisor};
    }
    const auto* divisor = right<Scalar>();
    if (!divisor) return wrong_types();
    const auto unit_of = [&](Unit unit) { return divisor->unit == Unit::None ? unit : Unit::None; };
    const Value result = mapped(
        left_, [&](auto x) { return x / divisor->value; }, unit_of);
    if (is_nothing(result)) return wrong_types();
    return divisor->value == 0 ? division_by_zero() : result;
  }

  const Value& left_;
  Operator op_;
  const Value& right_;
  const OperatorPlace& where_;
  DiagnosticSink& sink_;
};

}  // namespace

bool is_finite(const Value& value) noexcept {
  if (const auto* scalar = get_if<Scalar>(&value)) return std::isfinite(scalar->value);
  if (const auto* triple = get_if<Triple>(&value)) return render::is_finite(triple->value);
  if (const auto* angle = get_if<Angle>(&value)) return std::isfinite(angle->degrees);
  if (const auto* angles = get_if<AngleTriple>(&value)) return render::is_finite(angles->degrees);
  if (const auto* color = get_if<LinearRgb>(&value)) return render::is_finite(*color);
  return true;
}

std::string_view spelling(Operator op) noexcept {
  switch (op) {
    case Operator::None: return "";
    case Operator::Add: return "+";
    case Operator::Subtract: return "-";
    case Operator::Multiply: return "*";
    case Operator::Divide: return "/";
    case Operator::Less: return "<";
    case Operator::LessEqual: return "<=";
    case Operator::Greater: return ">";
    case Operator::GreaterEqual: return ">=";
    case Operator::Equal: return "==";
    case Operator::NotEqual: return "!=";
  }
  return "";
}

Location OperatorPlace::location() const {
  const SyntaxTree& tree = left.tree();
  Span span{left.span().end, right.span().begin};
  const std::size_t first = tree.text(span).find_first_of("+-*/^");
  if (first == std::string_view::npos) return right.location();
  span.begin += static_cast<std::uint32_t>(first);
  span.end = span.begin + 1;
  return tree.location(span);
}

Value evaluate_operation(const Value& left, Operator op, const Value& right,
                         const OperatorPlace& where, DiagnosticSink& sink) {
  return Operation(left, op, right, where, sink).run();
}

Value evaluate_power(const Value& base, const Value& exponent, const OperatorPlace& where,
                     DiagnosticSink& sink) {
  if (is_nothing(base) || is_nothing(exponent)) return Nothing{};
  const auto* x = get_if<Scalar>(&base);
  const auto* y = get_if<Scalar>(&exponent);
  if (!x || !y || y->unit != Unit::None) {
    sink.report(diag::wrong_operands, where.location(), "^", describe(base), describe(exponent));
    return Nothing{};
  }

  const std::optional<double> result = raise(x->value, y->value);
  if (!result && x->value == 0) {
    sink.report(diag::division_by_zero, where.location());
    return Nothing{};
  }
  if (!result) {
    sink.report(diag::no_real_result, where.location(), "^",
                "a negative number and a fractional exponent");
    return Nothing{};
  }
  if (!std::isfinite(*result)) {
    sink.report(diag::overflow, where.location(), "^");
    return Nothing{};
  }
  return Scalar{*result, y->value == 1 ? x->unit : Unit::None};
}

Value evaluate_negative(const Value& operand, Location where, DiagnosticSink& sink) {
  if (const auto* scalar = get_if<Scalar>(&operand)) return Scalar{-scalar->value, scalar->unit};
  if (const auto* triple = get_if<Triple>(&operand)) return Triple{-triple->value, triple->unit};
  if (const auto* angle = get_if<Angle>(&operand)) return Angle{-angle->degrees};
  if (const auto* angles = get_if<AngleTriple>(&operand)) return AngleTriple{-angles->degrees};
  if (!is_nothing(operand)) sink.report(diag::wrong_operand, where, "-", describe(operand));
  return Nothing{};
}

}  // namespace sdlc::lang
