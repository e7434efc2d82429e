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
constexpr std::size_t kAnyNumber = static_cast<std::size_t>(-1);

Value wrong_argument(const BuiltinCall& call, std::size_t i, std::string_view wanted) {
  const Location where = call.place(i);
  auto report =
      call.sink.report(diag::wrong_argument, where, call.name, wanted, describe(call.arguments[i]));
  const bool is_literal = call.node.child(i)->is(SyntaxKind::Number);
  if (wanted == kAngle && is_literal && holds_alternative<Scalar>(call.arguments[i])) {
    report.unsafe_fix({where.file, {where.span.end, where.span.end}}, "deg");
  } else if (wanted == kAngle && holds_alternative<Scalar>(call.arguments[i])) {
    report.help("a number becomes an angle by `x * 1deg`");
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

/// A number that has no unit, or every number where the unit is kept.
Value finite(const BuiltinCall& call, Scalar result) {
  if (std::isfinite(result.value)) return result;
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
  return x == nullptr ? wrong_argument(call, 0, "a number") : finite(call, {exp(x->value)});
}

Value evaluate_log(const BuiltinCall& call) {
  const auto* x = argument<Scalar>(call, 0);
  if (x == nullptr) return wrong_argument(call, 0, "a number");
  const std::optional<double> result = log(x->value);
  return result ? Value(Scalar{*result}) : no_result(call, "a number that is not positive");
}

// Trigonometry: angles in, or angles out

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
  return result ? Value(Angle{*result}) : no_result(call, "a number beyond -1 and 1");
}

Value evaluate_atan2(const BuiltinCall& call) {
  const auto *y = argument<Scalar>(call, 0), *x = argument<Scalar>(call, 1);
  if (y == nullptr) return wrong_argument(call, 0, "a number");
  if (x == nullptr) return wrong_argument(call, 1, "a number");
  const std::optional<double> result = atan2_degrees(y->value, x->value);
  return result ? Value(Angle{*result}) : no_result(call, "0, 0");
}

// Functions of several values of one type

bool is_less(const Value& a, const Value& b) {
  if (const auto* x = get_if<Scalar>(&a)) return x->value < get<Scalar>(b).value;
  return get<Angle>(a).degrees < get<Angle>(b).degrees;
}

/// The arguments, or the elements of the list that is the only one. A list is not copied: `range`
/// makes long ones of nothing.
class Comparable {
 public:
  explicit Comparable(const BuiltinCall& call)
      : call_(call), list_(call.arguments.size() == 1 ? argument<ListValue>(call, 0) : nullptr) {}

  std::size_t size() const { return list_ != nullptr ? list_->size() : call_.arguments.size(); }
  Value operator[](std::size_t i) const {
    return list_ != nullptr ? (*list_)[i] : call_.arguments[i];
  }
  /// Whether they are some numbers, or some angles; if not, that is reported.
  bool check() const {
    const Value first = size() > 0 ? (*this)[0] : Value();
    for (std::size_t i = 0; i < size(); ++i) {
      const Value value = (*this)[i];
      const bool is_ordered = holds_alternative<Scalar>(value) || holds_alternative<Angle>(value);
      if (is_ordered && are_of_one_type(first, value)) continue;
      wrong_argument(call_, list_ != nullptr ? 0 : i, "numbers, or angles, of one unit");
      return false;
    }
    if (size() == 0) no_result(call_, "an empty list");
    return size() > 0;
  }

 private:
  const BuiltinCall& call_;
  const ListValue* list_;
};

Value evaluate_min(const BuiltinCall& call) {
  const Comparable values(call);
  if (!values.check()) return Nothing{};
  Value least = values[0];
  for (std::size_t i = 1; i < values.size(); ++i) {
    if (is_less(values[i], least)) least = values[i];
  }
  return least;
}

Value evaluate_max(const BuiltinCall& call) {
  const Comparable values(call);
  if (!values.check()) return Nothing{};
  Value greatest = values[0];
  for (std::size_t i = 1; i < values.size(); ++i) {
    if (is_less(greatest, values[i])) greatest = values[i];
  }
  return greatest;
}

Value evaluate_clamp(const BuiltinCall& call) {
  const Comparable values(call);
  if (!values.check()) return Nothing{};
  const Value x = values[0], low = values[1], high = values[2];
  if (is_less(high, low)) return no_result(call, "a low end above the high one");
  return is_less(x, low) ? low : is_less(high, x) ? high : x;
}

/// The remainder of numbers far apart is found bit by bit.
std::uint64_t steps_of_mod(std::span<const Value> arguments) {
  constexpr int kBits = 4;  // in a step
  const auto exponent = [](const Value& value) {
    if (const auto* number = get_if<Scalar>(&value)) return std::ilogb(number->value);
    const auto* angle = get_if<Angle>(&value);
    return angle != nullptr ? std::ilogb(angle->degrees) : 0;
  };
  const double apart = static_cast<double>(exponent(arguments[0])) - exponent(arguments[1]);
  return apart > 0 ? static_cast<std::uint64_t>(std::fmin(apart, 3000)) / kBits : 0;
}

Value evaluate_mod(const BuiltinCall& call) {
  const Comparable values(call);
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
    // range(n) counts to n, range(a, b, step) from a to b.
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
  return finite(call, {dot(a->value, b->value)});
}

Value evaluate_cross(const BuiltinCall& call) {
  const auto *a = argument<Triple>(call, 0), *b = argument<Triple>(call, 1);
  if (a == nullptr) return wrong_argument(call, 0, "a vector");
  if (b == nullptr) return wrong_argument(call, 1, "a vector");
  const Vec3 result = cross(a->value, b->value);
  if (is_finite(result)) return Triple{result};
  call.sink.report(diag::overflow, call.where(), call.name);
  return Nothing{};
}

/// The length without overflow on the way.
double length_of(Vec3 v) noexcept {
  if (v == Vec3{}) return 0;
  const int e = render::exponent_of(max_abs(v));
  return std::ldexp(render::length(render::scaled_by_power_of_two(v, -e)), e);
}

Value evaluate_length(const BuiltinCall& call) {
  const auto* v = argument<Triple>(call, 0);
  return v == nullptr ? wrong_argument(call, 0, "a vector")
                      : finite(call, {length_of(v->value), v->unit});
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
  if (const auto* a = argument<Scalar>(call, 0)) {
    const auto* b = argument<Scalar>(call, 1);
    return finite(call, {mixed(a->value, b->value), a->unit == Unit::None ? b->unit : a->unit});
  }
  const auto checked = [&](auto result, bool is_finite) {
    if (is_finite) return Value(result);
    call.sink.report(diag::overflow, call.where(), call.name);
    return Value(Nothing{});
  };
  if (const auto* a = argument<Triple>(call, 0)) {
    const auto* b = argument<Triple>(call, 1);
    const Vec3 result = mixed(a->value, b->value);
    return checked(Triple{result, a->unit == Unit::None ? b->unit : a->unit}, is_finite(result));
  }
  if (const auto* a = argument<Angle>(call, 0)) {
    const double result = mixed(a->degrees, argument<Angle>(call, 1)->degrees);
    return checked(Angle{result}, std::isfinite(result));
  }
  if (const auto* a = argument<LinearRgb>(call, 0)) {
    const LinearRgb result = mixed(*a, *argument<LinearRgb>(call, 1));
    return checked(result, is_finite(result));
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
    {"sqrt", "sqrt(x)", 1, 1, evaluate_sqrt, "numbers",
     "Square root of a number that is not negative."},
    {"abs", "abs(x)", 1, 1, evaluate_abs, "numbers", "The number or angle without its sign."},
    {"min", "min(a, b, …)", 1, kAnyNumber, evaluate_min, "numbers",
     "The least of numbers or angles, or of a list of them."},
    {"max", "max(a, b, …)", 1, kAnyNumber, evaluate_max, "numbers",
     "The greatest of numbers or angles, or of a list of them."},
    {"clamp", "clamp(x, low, high)", 3, 3, evaluate_clamp, "numbers",
     "`x`, but not below `low` nor above `high`; of angles too."},
    {"floor", "floor(x)", 1, 1, keeping_unit<round_down>, "numbers",
     "The greatest whole number that is not above `x`."},
    {"ceil", "ceil(x)", 1, 1, keeping_unit<round_up>, "numbers",
     "The least whole number that is not below `x`."},
    {"round", "round(x)", 1, 1, keeping_unit<round_half_away>, "numbers",
     "The nearest whole number; of two, the one farther from 0."},
    {"exp", "exp(x)", 1, 1, evaluate_exp, "numbers", "e to the power of `x`.", 60},
    {"log", "log(x)", 1, 1, evaluate_log, "numbers", "The natural logarithm of a positive number.",
     60},
    {"sin", "sin(angle)", 1, 1, of_angle<sin_degrees>, "angles", "Sine.", 65},
    {"cos", "cos(angle)", 1, 1, of_angle<cos_degrees>, "angles", "Cosine.", 65},
    {"tan", "tan(angle)", 1, 1, evaluate_tan, "angles",
     "Tangent; there is none at odd multiples of 90deg.", 70},
    {"asin", "asin(x)", 1, 1, arc<asin_degrees>, "angles",
     "The angle from -90deg to 90deg whose sine is `x`.", 45},
    {"acos", "acos(x)", 1, 1, arc<acos_degrees>, "angles",
     "The angle from 0deg to 180deg whose cosine is `x`.", 45},
    {"atan2", "atan2(y, x)", 2, 2, evaluate_atan2, "angles",
     "The angle from the x axis to the point (x, y), from -180deg to 180deg.", 45},
    {"mod", "mod(a, b)", 2, 2, evaluate_mod, "numbers",
     "What is left of `a` after whole multiples of `b`, exactly, with the sign of `b`; of angles"
     " too.",
     5, steps_of_mod},
    {"sum", "sum(list)", 1, 1, evaluate_sum, "lists",
     "The sum of what is in a list: numbers, points, angles or colours."},
    {"len", "len(list)", 1, 1, evaluate_len, "lists", "How many elements a list has.", 0},
    {"str", "str(x)", 1, 1, evaluate_str, "lists",
     "The shortest text that reads back as the same value; a string as it is.", 35},
    {"dot", "dot(a, b)", 2, 2, evaluate_dot, "vectors", "Inner product."},
    {"cross", "cross(a, b)", 2, 2, evaluate_cross, "vectors", "Vector product, right-handed."},
    {"length", "length(v)", 1, 1, evaluate_length, "vectors",
     "Length, with the unit of the vector.", 5},
    {"normalize", "normalize(v)", 1, 1, evaluate_normalize, "vectors",
     "The vector of length 1 in the direction of `v`, which is not (0, 0, 0).", 5},
    {"mix", "mix(a, b, t)", 3, 3, evaluate_mix, "numbers",
     "`a * (1 - t) + b * t` of numbers, angles, vectors or colours."},
    {"random", "random(a, …)", 1, kAnyNumber, evaluate_random, "randomness",
     "Uniform from 0 up to, and without, 1: the same arguments give the same number.", 3},
    {"noise", "noise(p)", 1, 1, evaluate_noise, "randomness",
     "Smooth noise between -1 and 1 at a point of space.", 14},
    {"range", "range(n), range(a, b), range(a, b, step)", 1, 3, evaluate_range, "lists",
     "The whole numbers from 0 or `a` up to, and without, `n` or `b`."},
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
