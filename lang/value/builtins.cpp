#include "lang/value/builtins.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include <fmt/format.h>

#include "lang/math/elementary.hpp"
#include "lang/math/random.hpp"
#include "lang/object/object.hpp"
#include "lang/value/arithmetic.hpp"
#include "lang/value/logic.hpp"
#include "render/math/color.hpp"
#include "render/math/power_of_two.hpp"
#include "render/math/vec3.hpp"

namespace sdlc::lang {
namespace {

using render::LinearRgb;
using render::Vec3;

constexpr std::string_view kAngle = "an angle";

Value wrong_argument(const BuiltinCall& call, std::size_t i, std::string_view wanted) {
  const Location where = call.place(i);
  auto report =
      call.sink.report(diag::wrong_argument, where, call.name, wanted, describe(call.arguments[i]));
  const bool is_literal = call.node.child(i)->is(SyntaxKind::Number);
  if (wanted == kAngle && is_literal && holds_alternative<Scalar>(call.arguments[i])) {
    report.unsafe_fix({where.file, {where.span.end, where.span.end}}, "deg");
  } else if (wanted == kAngle && holds_alternative<Scalar>(call.arguments[i])) {
    report.help("multiply a number by `1deg` to get an angle: `x * 1deg`");
  }
  return Nothing{};
}

template <typename T>
const T* argument(const BuiltinCall& call, std::size_t i) noexcept {
  return get_if<T>(&call.arguments[i]);
}

Value no_result(const BuiltinCall& call, std::string_view argument) {
  call.sink.report(diag::no_real_result, call.where(), call.name, argument);
  return Nothing{};
}

/// The result if it is finite; else an overflow is reported.
Value finite(const BuiltinCall& call, Value result) {
  if (is_finite(result)) return result;
  call.sink.report(diag::overflow, call.where(), call.name);
  return Nothing{};
}

// Functions of one number

template <double (*function)(double) noexcept>
Value keeping_unit(const BuiltinCall& call) {
  const auto* x = argument<Scalar>(call, 0);
  if (x == nullptr) return wrong_argument(call, 0, "a number");
  return Scalar{function(x->value), x->unit};
}

double absolute(double x) noexcept { return std::fabs(x); }
double round_down(double x) noexcept { return std::floor(x); }
double round_up(double x) noexcept { return std::ceil(x); }

Value evaluate_abs(const BuiltinCall& call) {
  if (const auto* angle = argument<Angle>(call, 0)) return Angle{std::fabs(angle->degrees)};
  return keeping_unit<absolute>(call);
}

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

// Trigonometry

template <double (*function)(double) noexcept>
Value of_angle(const BuiltinCall& call) {
  const auto* x = argument<Angle>(call, 0);
  return x == nullptr ? wrong_argument(call, 0, kAngle) : Scalar{function(x->degrees)};
}

Value evaluate_tan(const BuiltinCall& call) {
  const auto* x = argument<Angle>(call, 0);
  if (x == nullptr) return wrong_argument(call, 0, kAngle);
  const std::optional<double> result = tan_degrees(x->degrees);
  return result ? Value(Scalar{*result}) : no_result(call, "an odd multiple of 90deg");
}

template <std::optional<double> (*function)(double) noexcept>
Value arc(const BuiltinCall& call) {
  const auto* x = argument<Scalar>(call, 0);
  if (x == nullptr || x->unit != Unit::None) return wrong_argument(call, 0, "a number");
  const std::optional<double> result = function(x->value);
  return result ? Value(Angle{*result}) : no_result(call, "a number outside -1 to 1");
}

Value evaluate_atan2(const BuiltinCall& call) {
  const auto *y = argument<Scalar>(call, 0), *x = argument<Scalar>(call, 1);
  if (y == nullptr) return wrong_argument(call, 0, "a number");
  if (x == nullptr) return wrong_argument(call, 1, "a number");
  const std::optional<double> result = atan2_degrees(y->value, x->value);
  return result ? Value(Angle{*result}) : no_result(call, "(0, 0)");
}

// Functions of several values of one type

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
  /// Whether they are numbers of one unit or angles, and at least one; if not, that is reported.
  bool check() const {
    const Value first = size() > 0 ? (*this)[0] : Value();
    for (std::size_t i = 0; i < size(); ++i) {
      const Value value = (*this)[i];
      const bool is_ordered = holds_alternative<Scalar>(value) || holds_alternative<Angle>(value);
      if (is_ordered && are_of_one_type(first, value)) continue;
      wrong_argument(call_, list_ != nullptr ? 0 : i, "numbers of one unit or angles");
      return false;
    }
    if (size() == 0) no_result(call_, "an empty list");
    return size() > 0;
  }

 private:
  const BuiltinCall& call_;
  const ListValue* list_;
};

bool is_greater(const Value& a, const Value& b) { return is_less(b, a); }

/// The value that is before all others in an order; of equal ones the first.
template <bool (*is_before)(const Value&, const Value&)>
Value first_of(const BuiltinCall& call) {
  const Operands values(call);
  if (!values.check()) return Nothing{};
  Value first = values[0];
  for (std::size_t i = 1; i < values.size(); ++i) {
    if (is_before(values[i], first)) first = values[i];
  }
  return first;
}

Value evaluate_clamp(const BuiltinCall& call) {
  const Operands values(call);
  if (!values.check()) return Nothing{};
  const Value x = values[0], low = values[1], high = values[2];
  if (is_less(high, low)) return no_result(call, "a `low` above `high`");
  return is_less(x, low) ? low : is_less(high, x) ? high : x;
}

/// fmod computes the quotient bit by bit.
std::uint64_t steps_of_mod(std::span<const Value> arguments) {
  constexpr int kBitsPerStep = 4;
  const auto exponent = [](const Value& value) {
    if (const auto* number = get_if<Scalar>(&value)) return std::ilogb(number->value);
    const auto* angle = get_if<Angle>(&value);
    return angle != nullptr ? std::ilogb(angle->degrees) : 0;
  };
  const double bits = static_cast<double>(exponent(arguments[0])) - exponent(arguments[1]);
  return bits > 0 ? static_cast<std::uint64_t>(std::fmin(bits, 3000)) / kBitsPerStep : 0;
}

Value evaluate_mod(const BuiltinCall& call) {
  const Operands values(call);
  if (!values.check()) return Nothing{};
  const Value a = values[0], b = values[1];
  const auto* number = get_if<Scalar>(&a);
  const double x = number != nullptr ? number->value : get<Angle>(a).degrees;
  const double y = number != nullptr ? get<Scalar>(b).value : get<Angle>(b).degrees;
  const std::optional<double> result = modulo(x, y);
  if (!result) {
    call.sink.report(diag::division_by_zero, call.where());
    return Nothing{};
  }
  if (number != nullptr) return Scalar{*result, number->unit};
  return Angle{*result};
}

// Lists and strings

Value evaluate_sum(const BuiltinCall& call) {
  const auto* list = argument<ListValue>(call, 0);
  if (list == nullptr) return wrong_argument(call, 0, "a list");
  if (list->size() == 0) return Scalar{};
  Value sum = (*list)[0];
  const ast::Node place = *call.node.child(0);
  for (std::size_t i = 1; i < list->size() && !is_nothing(sum); ++i) {
    sum = evaluate_operation(sum, Operator::Add, (*list)[i], {place, place}, call.sink);
  }
  return sum;
}

Value evaluate_len(const BuiltinCall& call) {
  const auto* list = argument<ListValue>(call, 0);
  if (list == nullptr) return wrong_argument(call, 0, "a list");
  return Scalar{static_cast<double>(list->size())};
}

Value evaluate_str(const BuiltinCall& call) {
  if (const auto* text = argument<std::string>(call, 0)) return *text;
  const Value& value = call.arguments[0];
  const bool has_text = holds_alternative<bool>(value) || holds_alternative<Scalar>(value) ||
                        holds_alternative<Angle>(value) || holds_alternative<Triple>(value) ||
                        holds_alternative<AngleTriple>(value) ||
                        holds_alternative<LinearRgb>(value);
  if (has_text) return to_text(value);
  return wrong_argument(call, 0, "a number, angle, point, colour, string, true or false");
}

Value evaluate_range(const BuiltinCall& call) {
  std::array<double, 3> numbers{0, 0, 1};
  for (std::size_t i = 0; i < call.arguments.size(); ++i) {
    const auto* x = argument<Scalar>(call, i);
    if (x == nullptr || x->unit != Unit::None) return wrong_argument(call, i, "a whole number");
    if (x->value != std::floor(x->value) || std::fabs(x->value) > 0x1p53) {
      call.sink.report(diag::not_whole, call.place(i), call.name, to_text(x->value))
          .help("round it with `floor(…)` or `round(…)`");
      return Nothing{};
    }
    // range(n), range(first, end) or range(first, end, step)
    numbers[call.arguments.size() == 1 ? 1 : i] = x->value;
  }
  const auto [first, end, step] = numbers;
  if (step == 0) return no_result(call, "a step of 0");
  const double count = std::fmax(0, std::ceil((end - first) / step));
  return ListValue(first, step, static_cast<std::size_t>(count));
}

// Vectors and colours

Value evaluate_dot(const BuiltinCall& call) {
  const auto *a = argument<Triple>(call, 0), *b = argument<Triple>(call, 1);
  if (a == nullptr) return wrong_argument(call, 0, "a vector");
  if (b == nullptr) return wrong_argument(call, 1, "a vector");
  return finite(call, Scalar{dot(a->value, b->value)});
}

Value evaluate_cross(const BuiltinCall& call) {
  const auto *a = argument<Triple>(call, 0), *b = argument<Triple>(call, 1);
  if (a == nullptr) return wrong_argument(call, 0, "a vector");
  if (b == nullptr) return wrong_argument(call, 1, "a vector");
  return finite(call, Triple{cross(a->value, b->value)});
}

/// The length, scaled by a power of two so that no square overflows or underflows.
double length_of(Vec3 v) noexcept {
  if (v == Vec3{}) return 0;
  const int e = render::exponent_of(max_abs(v));
  return std::ldexp(render::length(render::scaled_by_power_of_two(v, -e)), e);
}

Value evaluate_length(const BuiltinCall& call) {
  const auto* v = argument<Triple>(call, 0);
  return v == nullptr ? wrong_argument(call, 0, "a vector")
                      : finite(call, Scalar{length_of(v->value), v->unit});
}

Value evaluate_normalize(const BuiltinCall& call) {
  const auto* v = argument<Triple>(call, 0);
  if (v == nullptr) return wrong_argument(call, 0, "a vector");
  if (v->value == Vec3{}) return no_result(call, "the zero vector");
  return Triple{render::unit(render::with_moderate_length(v->value))};
}

Value evaluate_mix(const BuiltinCall& call) {
  const auto* t = argument<Scalar>(call, 2);
  if (t == nullptr || t->unit != Unit::None) return wrong_argument(call, 2, "a number");
  if (!are_of_one_type(call.arguments[0], call.arguments[1])) {
    return wrong_argument(call, 1, fmt::format("{} like the first", describe(call.arguments[0])));
  }
  const auto mixed = [&](auto a, auto b) { return a * (1 - t->value) + b * t->value; };
  const auto with_unit = [&]<typename V>(const V& a, const V& b) {
    return finite(call, V{mixed(a.value, b.value), common_unit(a.unit, b.unit)});
  };
  if (const auto* a = argument<Scalar>(call, 0)) return with_unit(*a, *argument<Scalar>(call, 1));
  if (const auto* a = argument<Triple>(call, 0)) return with_unit(*a, *argument<Triple>(call, 1));
  if (const auto* a = argument<Angle>(call, 0)) {
    return finite(call, Angle{mixed(a->degrees, argument<Angle>(call, 1)->degrees)});
  }
  if (const auto* a = argument<LinearRgb>(call, 0)) {
    return finite(call, mixed(*a, *argument<LinearRgb>(call, 1)));
  }
  return wrong_argument(call, 0, "two numbers, vectors, angles or colours");
}

// Randomness

Value evaluate_random(const BuiltinCall& call) {
  RandomHash hash;
  for (std::size_t i = 0; i < call.arguments.size(); ++i) {
    if (const auto* number = argument<Scalar>(call, i)) {
      hash.add_number(number->value);
    } else if (const auto* flag = argument<bool>(call, i)) {
      hash.add_bool(*flag);
    } else if (const auto* text = argument<std::string>(call, i)) {
      hash.add_string(*text);
    } else if (const auto* v = argument<Triple>(call, i)) {
      hash.add_vec3(v->value);
    } else if (const auto* angle = argument<Angle>(call, i)) {
      hash.add_angle(angle->degrees);
    } else {
      return wrong_argument(call, i, "numbers, strings, vectors, angles, true or false");
    }
  }
  return Scalar{hash.uniform()};
}

Value evaluate_noise(const BuiltinCall& call) {
  const auto* p = argument<Triple>(call, 0);
  return p == nullptr ? wrong_argument(call, 0, "a vector") : Scalar{noise(p->value)};
}

constexpr auto kBuiltins = std::to_array<Builtin>({
    {"sqrt", "sqrt(x)", 1, 1, evaluate_sqrt, "number", "number", "numbers",
     "Square root of a number that is not negative."},
    {"abs", "abs(x)", 1, 1, evaluate_abs, "number", "=", "numbers",
     "The number or angle without its sign."},
    {"min", "min(a, b, …)", 1, kAnyNumber, first_of<is_less>, "number", "=", "numbers",
     "The smallest of several numbers or angles, or of a list of them."},
    {"max", "max(a, b, …)", 1, kAnyNumber, first_of<is_greater>, "number", "=", "numbers",
     "The largest of several numbers or angles, or of a list of them."},
    {"clamp", "clamp(x, low, high)", 3, 3, evaluate_clamp, "number", "=", "numbers",
     "`x` limited to `low` … `high`; also for angles."},
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
    {"sin", "sin(angle)", 1, 1, of_angle<sin_degrees>, "angle", "number", "angles", "Sine.", 65},
    {"cos", "cos(angle)", 1, 1, of_angle<cos_degrees>, "angle", "number", "angles", "Cosine.", 65},
    {"tan", "tan(angle)", 1, 1, evaluate_tan, "angle", "number", "angles",
     "Tangent; undefined at odd multiples of 90deg.", 70},
    {"asin", "asin(x)", 1, 1, arc<asin_degrees>, "number", "angle", "angles",
     "The angle from -90deg to 90deg whose sine is `x`.", 45},
    {"acos", "acos(x)", 1, 1, arc<acos_degrees>, "number", "angle", "angles",
     "The angle from 0deg to 180deg whose cosine is `x`.", 45},
    {"atan2", "atan2(y, x)", 2, 2, evaluate_atan2, "number", "angle", "angles",
     "The angle from the x axis to the point (x, y), from -180deg to 180deg.", 45},
    {"mod", "mod(a, b)", 2, 2, evaluate_mod, "number", "=", "numbers",
     "The remainder of `a / b`, exact, with the sign of `b`; also for angles.", 5, steps_of_mod},
    {"sum", "sum(list)", 1, 1, evaluate_sum, "list", "", "lists",
     "The sum of a list of numbers, points, angles or colours."},
    {"len", "len(list)", 1, 1, evaluate_len, "list", "number", "lists",
     "The number of elements of a list.", 0},
    {"str", "str(x)", 1, 1, evaluate_str, "", "string", "lists",
     "The shortest text that reads back as the same value; a string is unchanged.", 35},
    {"dot", "dot(a, b)", 2, 2, evaluate_dot, "vec3", "number", "vectors", "Dot product."},
    {"cross", "cross(a, b)", 2, 2, evaluate_cross, "vec3", "vec3", "vectors",
     "Cross product, right-handed."},
    {"length", "length(v)", 1, 1, evaluate_length, "vec3", "number", "vectors",
     "Length, with the unit of the vector.", 5},
    {"normalize", "normalize(v)", 1, 1, evaluate_normalize, "vec3", "vec3", "vectors",
     "The vector of length 1 in the direction of `v`, which is not (0, 0, 0).", 5},
    {"mix", "mix(a, b, t)", 3, 3, evaluate_mix, "", "=", "numbers",
     "`a * (1 - t) + b * t` of numbers, angles, vectors or colours."},
    {"random", "random(a, …)", 1, kAnyNumber, evaluate_random, "", "number", "randomness",
     "A random number, uniform in [0, 1); the same arguments give the same number.", 3},
    {"noise", "noise(p)", 1, 1, evaluate_noise, "vec3", "number", "randomness",
     "Smooth noise between -1 and 1 at a point in space.", 14},
    {"range", "range(n), range(a, b), range(a, b, step)", 1, 3, evaluate_range, "number", "list",
     "lists",
     "The whole numbers from 0 to `n - 1`, or from `a` in steps of `step` (default 1) before `b`."},
});

}  // namespace

std::span<const Builtin> all_builtins() noexcept { return kBuiltins; }

std::size_t Builtin::index() const noexcept {
  return static_cast<std::size_t>(this - kBuiltins.data());
}

const Builtin* find_builtin(std::string_view name) noexcept {
  static const std::unordered_map<std::string_view, const Builtin*> by_name = [] {
    std::unordered_map<std::string_view, const Builtin*> map;
    for (const Builtin& builtin : kBuiltins) map.emplace(builtin.name, &builtin);
    return map;
  }();
  const auto found = by_name.find(name);
  return found == by_name.end() ? nullptr : found->second;
}

}  // namespace sdlc::lang
