#include "lang/value/arithmetic.hpp"

#include <cmath>
#include <optional>
#include <string_view>

#include "lang/math/elementary.hpp"

namespace sdlc::lang {
namespace {

using render::LinearRgb;
using render::Vec3;

std::string_view spelling(Operator op) noexcept {
  switch (op) {
    case Operator::Add: return "+";
    case Operator::Subtract: return "-";
    case Operator::Multiply: return "*";
    case Operator::Divide: return "/";
    default: return "";
  }
}

/// The numbers of a value of any type that computes componentwise.
bool is_finite(const Value& value) noexcept {
  if (const auto* scalar = get_if<Scalar>(&value)) return std::isfinite(scalar->value);
  if (const auto* triple = get_if<Triple>(&value)) return render::is_finite(triple->value);
  if (const auto* angle = get_if<Angle>(&value)) return std::isfinite(angle->degrees);
  if (const auto* angles = get_if<AngleTriple>(&value)) return render::is_finite(angles->degrees);
  if (const auto* color = get_if<LinearRgb>(&value)) return render::is_finite(*color);
  return true;
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
    sink_.report(diag::wrong_operands, where_.location(), spelling(op_), describe(left_),
                 describe(right_));
    return Nothing{};
  }

  template <typename T>
  T add(T a, T b) const noexcept {
    return op_ == Operator::Add ? a + b : a - b;
  }

  /// A plain number takes the other's unit; metres and seconds do not add up (ruling 20).
  template <typename T>
  Value tagged_sum(const T& a, const T& b) {
    const bool agree = a.unit == b.unit || a.unit == Unit::None || b.unit == Unit::None;
    if (!agree) return wrong_types();
    return T{add(a.value, b.value), a.unit == Unit::None ? b.unit : a.unit};
  }

  Value sum() {
    if (left<Scalar>() && right<Scalar>()) return tagged_sum(*left<Scalar>(), *right<Scalar>());
    if (left<Triple>() && right<Triple>()) return tagged_sum(*left<Triple>(), *right<Triple>());
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

  /// A factor without a unit keeps the other's; any other product drops it.
  static Unit product_unit(Unit a, Unit b) noexcept {
    if (a == Unit::None) return b;
    return b == Unit::None ? a : Unit::None;
  }

  static Value scaled(const Value& value, Scalar factor) {
    if (const auto* scalar = get_if<Scalar>(&value)) {
      return Scalar{scalar->value * factor.value, product_unit(scalar->unit, factor.unit)};
    }
    if (const auto* triple = get_if<Triple>(&value)) {
      return Triple{triple->value * factor.value, product_unit(triple->unit, factor.unit)};
    }
    if (const auto* angle = get_if<Angle>(&value)) return Angle{angle->degrees * factor.value};
    if (const auto* angles = get_if<AngleTriple>(&value)) {
      return AngleTriple{angles->degrees * factor.value};
    }
    if (const auto* color = get_if<LinearRgb>(&value)) return *color * factor.value;
    return Nothing{};
  }

  Value product() {
    if (left<LinearRgb>() && right<LinearRgb>()) return *left<LinearRgb>() * *right<LinearRgb>();
    Value result;
    if (right<Scalar>())
      result = scaled(left_, *right<Scalar>());
    else if (left<Scalar>())
      result = scaled(right_, *left<Scalar>());
    return is_nothing(result) ? wrong_types() : result;
  }

  Value by_zero() {
    sink_.report(diag::division_by_zero, where_.location());
    return Nothing{};
  }

  Value quotient() {
    if (left<Angle>() && right<Angle>()) {
      if (right<Angle>()->degrees == 0) return by_zero();
      return Scalar{left<Angle>()->degrees / right<Angle>()->degrees};
    }
    if (!right<Scalar>()) return wrong_types();
    const double divisor = right<Scalar>()->value;
    const Unit unit = right<Scalar>()->unit;
    if (left<Scalar>()) {
      if (divisor == 0) return by_zero();
      return Scalar{left<Scalar>()->value / divisor,
                    unit == Unit::None ? left<Scalar>()->unit : Unit::None};
    }
    if (left<Triple>()) {
      if (divisor == 0) return by_zero();
      return Triple{left<Triple>()->value / divisor,
                    unit == Unit::None ? left<Triple>()->unit : Unit::None};
    }
    if (!left<Angle>() && !left<AngleTriple>() && !left<LinearRgb>()) return wrong_types();
    if (divisor == 0) return by_zero();
    if (left<Angle>()) return Angle{left<Angle>()->degrees / divisor};
    if (left<AngleTriple>()) return AngleTriple{left<AngleTriple>()->degrees / divisor};
    return *left<LinearRgb>() / divisor;
  }

  const Value& left_;
  Operator op_;
  const Value& right_;
  const OperatorPlace& where_;
  DiagnosticSink& sink_;
};

}  // namespace

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
                "a negative number and a broken exponent");
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
