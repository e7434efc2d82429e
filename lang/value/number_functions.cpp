#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "lang/math/elementary.hpp"
#include "lang/value/arithmetic.hpp"
#include "lang/value/builtin_call.hpp"
#include "lang/value/builtin_tables.hpp"
#include "lang/value/element_type.hpp"
#include "lang/value/logic.hpp"
#include "render/math/color.hpp"

namespace sdlc::lang {
namespace {

template <double (*function)(double) noexcept>
Value keeping_unit(const BuiltinCall& call) {
  const auto* x = argument<Scalar>(call, 0);
  if (x == nullptr) return wrong_argument(call, 0, "a number");
  return Scalar{function(x->value), x->unit};
}

double absolute(double x) noexcept { return std::fabs(x); }
double round_down(double x) noexcept { return std::floor(x); }
double round_up(double x) noexcept { return std::ceil(x); }

/// The function of each component.
template <typename Function>
Triple by_component(const Triple& a, const Triple& b, Function function) {
  const auto [x, y, z] = a.value;
  return {{function(x, b.value.x), function(y, b.value.y), function(z, b.value.z)},
          common_unit(a.unit, b.unit)};
}

Value evaluate_abs(const BuiltinCall& call) {
  if (const auto* v = argument<Triple>(call, 0)) {
    return Triple{{std::fabs(v->value.x), std::fabs(v->value.y), std::fabs(v->value.z)}, v->unit};
  }
  if (const auto* angle = argument<Angle>(call, 0)) return Angle{std::fabs(angle->degrees)};
  return keeping_unit<absolute>(call);
}

Value evaluate_sign(const BuiltinCall& call) {
  const auto* angle = argument<Angle>(call, 0);
  const auto* number = argument<Scalar>(call, 0);
  if (angle == nullptr && number == nullptr) return wrong_argument(call, 0, "a number or an angle");
  const double x = angle != nullptr ? angle->degrees : number->value;
  return Scalar{static_cast<double>((x > 0) - (x < 0))};
}

double fraction(double x) noexcept { return x - std::floor(x); }

Value evaluate_sqrt(const BuiltinCall& call) {
  const auto* x = argument<Scalar>(call, 0);
  if (x == nullptr) return wrong_argument(call, 0, "a number");
  if (x->value < 0) return no_result(call, "a negative number");
  return Scalar{std::sqrt(x->value)};
}

Value evaluate_exp(const BuiltinCall& call) {
  const auto* x = argument<Scalar>(call, 0);
  return x == nullptr ? wrong_argument(call, 0, "a number") : finite(call, Scalar{exp(x->value)});
}

Value evaluate_log(const BuiltinCall& call) {
  const auto* x = argument<Scalar>(call, 0);
  if (x == nullptr) return wrong_argument(call, 0, "a number");
  const std::optional<double> result = log(x->value);
  return result ? Value(Scalar{*result}) : no_result(call, "a number that is not positive");
}

bool is_less(const Value& a, const Value& b) {
  if (const auto* x = get_if<Scalar>(&a)) return x->value < get<Scalar>(b).value;
  return get<Angle>(a).degrees < get<Angle>(b).degrees;
}

/// The arguments, or the elements of the list that is the only one. A list is not copied, because
/// `range` makes long ones that take no memory.
class Operands {
 public:
  explicit Operands(const BuiltinCall& call)
      : call_(call), list_(call.arguments.size() == 1 ? argument<ListValue>(call, 0) : nullptr) {}

  std::size_t size() const { return list_ != nullptr ? list_->size() : call_.arguments.size(); }
  Value operator[](std::size_t i) const {
    return list_ != nullptr ? (*list_)[i] : call_.arguments[i];
  }
  /// Whether they are numbers of one unit, angles, or vectors if these are allowed, and at least
  /// one; if not, that is reported.
  bool check(bool takes_vectors) {
    if (call_.arguments.size() == 1 && argument<RowValue>(call_, 0) != nullptr) {
      wrong_argument(call_, 0, kListWanted);
      return false;
    }
    for (std::size_t i = 0; i < size(); ++i) {
      const Value value = (*this)[i];
      const bool is_good = holds_alternative<Scalar>(value) || holds_alternative<Angle>(value) ||
                           (takes_vectors && holds_alternative<Triple>(value));
      if (is_good && type_.admit(value)) continue;
      wrong_argument(call_, list_ != nullptr ? 0 : i,
                     takes_vectors ? "numbers of one unit, angles or vectors"
                                   : "numbers of one unit or angles");
      return false;
    }
    if (size() == 0) no_result(call_, "an empty list");
    return size() > 0;
  }
  /// The value with the unit that all of them have in common: the unit of a result must not depend
  /// on which value wins.
  Value with_unit(const Value& value) const {
    const auto* number = get_if<Scalar>(&value);
    return number != nullptr ? Value(Scalar{number->value, type_.unit()}) : value;
  }

 private:
  const BuiltinCall& call_;
  const ListValue* list_;
  ElementType type_;
};

bool is_greater(const Value& a, const Value& b) { return is_less(b, a); }

double smaller(double a, double b) noexcept { return b < a ? b : a; }
double larger(double a, double b) noexcept { return b > a ? b : a; }

/// The value that is before all others in an order, the first of equal ones; of vectors, component
/// by component.
template <bool (*is_before)(const Value&, const Value&), double (*choose)(double, double) noexcept>
Value first_of(const BuiltinCall& call) {
  Operands values(call);
  if (!values.check(true)) return Nothing{};
  Value first = values[0];
  const bool is_vector = holds_alternative<Triple>(first);
  for (std::size_t i = 1; i < values.size(); ++i) {
    if (is_vector) {
      first = by_component(get<Triple>(first), get<Triple>(values[i]), choose);
    } else if (is_before(values[i], first)) {
      first = values[i];
    }
  }
  return values.with_unit(first);
}

Value evaluate_clamp(const BuiltinCall& call) {
  Operands values(call);
  if (!values.check(true)) return Nothing{};
  const Value x = values[0], low = values[1], high = values[2];
  if (const auto* v = get_if<Triple>(&x)) {
    const Triple &a = get<Triple>(low), &b = get<Triple>(high);
    const render::Vec3 size = b.value - a.value;
    if (smaller(size.x, smaller(size.y, size.z)) < 0)
      return no_result(call, "a `low` above `high`");
    return by_component(by_component(*v, a, larger), b, smaller);
  }
  if (is_less(high, low)) return no_result(call, "a `low` above `high`");
  return values.with_unit(is_less(x, low) ? low : is_less(high, x) ? high : x);
}

/// fmod computes the quotient bit by bit.
BuiltinWork work_of_mod(const BuiltinCall& call) {
  constexpr int kBitsPerStep = 4;
  const auto exponent = [](const Value& value) {
    if (const auto* number = get_if<Scalar>(&value)) return std::ilogb(number->value);
    const auto* angle = get_if<Angle>(&value);
    return angle != nullptr ? std::ilogb(angle->degrees) : 0;
  };
  const double bits =
      static_cast<double>(exponent(call.arguments[0])) - exponent(call.arguments[1]);
  return {.steps = bits > 0 ? static_cast<std::uint64_t>(std::fmin(bits, 3000)) / kBitsPerStep : 0};
}

Value evaluate_mod(const BuiltinCall& call) {
  Operands values(call);
  if (!values.check(false)) return Nothing{};
  const Value a = values[0], b = values[1];
  const auto* number = get_if<Scalar>(&a);
  const double x = number != nullptr ? number->value : get<Angle>(a).degrees;
  const double y = number != nullptr ? get<Scalar>(b).value : get<Angle>(b).degrees;
  const std::optional<double> result = modulo(x, y);
  if (!result) {
    call.sink.report(diag::division_by_zero, call.where());
    return Nothing{};
  }
  return number != nullptr ? values.with_unit(Scalar{*result}) : Angle{*result};
}

/// `a * (1 - t) + b * t`, where a and b are arguments of the call, one after the other.
Value mixed(const BuiltinCall& call, std::size_t index, double t) {
  const Value &first = call.arguments[index], &second = call.arguments[index + 1];
  if (!are_of_one_type(first, second)) {
    return wrong_argument(call, index + 1, fmt::format("{} like the one before", describe(first)));
  }
  const auto mix = [&](auto a, auto b) { return a * (1 - t) + b * t; };
  const auto with_unit = [&]<typename V>(const V& a, const V& b) {
    return finite(call, V{mix(a.value, b.value), common_unit(a.unit, b.unit)});
  };
  if (const auto* a = get_if<Scalar>(&first)) return with_unit(*a, get<Scalar>(second));
  if (const auto* a = get_if<Triple>(&first)) return with_unit(*a, get<Triple>(second));
  if (const auto* a = get_if<Angle>(&first)) {
    return finite(call, Angle{mix(a->degrees, get<Angle>(second).degrees)});
  }
  if (const auto* a = get_if<render::LinearRgb>(&first)) {
    return finite(call, mix(*a, get<render::LinearRgb>(second)));
  }
  return wrong_argument(call, index, "two numbers, vectors, angles or colours");
}

Value evaluate_mix(const BuiltinCall& call) {
  const auto* t = plain_number(call, 2);
  return t == nullptr ? wrong_argument(call, 2, "a number") : mixed(call, 0, t->value);
}

Value evaluate_remap(const BuiltinCall& call) {
  constexpr std::size_t kFirstOfResult = 3;
  const std::optional<double> t = share_of_interval(call, 0, 1);
  return t ? mixed(call, kFirstOfResult, *t) : Value();
}

constexpr auto kNumberFunctions = std::to_array<Builtin>({
    {"sqrt", "sqrt(x)", 1, 1, evaluate_sqrt, "number", "number", "numbers",
     "Square root of a number that is not negative."},
    {"abs", "abs(x)", 1, 1, evaluate_abs, "number", "=", "numbers",
     "The number or angle without its sign; of a vector, of each component."},
    {"min", "min(a, b, …)", 1, kAnyNumber, first_of<is_less, smaller>, "number", "=", "numbers",
     "The smallest of several numbers or angles, or of a list of them; of vectors, component by "
     "component."},
    {"max", "max(a, b, …)", 1, kAnyNumber, first_of<is_greater, larger>, "number", "=", "numbers",
     "The largest of several numbers or angles, or of a list of them; of vectors, component by "
     "component."},
    {"clamp", "clamp(x, low, high)", 3, 3, evaluate_clamp, "number", "=", "numbers",
     "`x` limited to `low` … `high`; also for angles, and for vectors, component by component."},
    {"floor", "floor(x)", 1, 1, keeping_unit<round_down>, "number", "=", "numbers",
     "The largest whole number not above `x`."},
    {"ceil", "ceil(x)", 1, 1, keeping_unit<round_up>, "number", "=", "numbers",
     "The smallest whole number not below `x`."},
    {"round", "round(x)", 1, 1, keeping_unit<round_half_away>, "number", "=", "numbers",
     "The nearest whole number; halves are rounded away from 0."},
    {"exp", "exp(x)", 1, 1, evaluate_exp, "number", "number", "numbers", "e to the power of `x`.",
     60},
    {"log", "log(x)", 1, 1, evaluate_log, "number", "number", "numbers",
     "The natural logarithm of a positive number.", 60},
    {"mod", "mod(a, b)", 2, 2, evaluate_mod, "number", "=", "numbers",
     "The remainder of `a / b`, exact, with the sign of `b`; also for angles.", 5, work_of_mod},
    {"mix", "mix(a, b, t)", 3, 3, evaluate_mix, "", "=", "numbers",
     "`a * (1 - t) + b * t` of numbers, angles, vectors or colours."},
    {"sign", "sign(x)", 1, 1, evaluate_sign, "number", "number", "numbers",
     "1 of a positive number or angle, -1 of a negative one, 0 of 0."},
    {"fract", "fract(x)", 1, 1, keeping_unit<fraction>, "number", "=", "numbers",
     "`x - floor(x)`: the part after the point, from 0 to 1."},
    {"remap", "remap(x, a, b, c, d)", 5, 5, evaluate_remap, "", "", "numbers",
     "Maps `a` … `b` linearly to `c` … `d`; values outside are extrapolated."},
});

}  // namespace

std::span<const Builtin> number_functions() noexcept { return kNumberFunctions; }

}  // namespace sdlc::lang
