#include "lang/value/builtins.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include <fmt/format.h>

#include "lang/value/logic.hpp"
#include "lang/math/elementary.hpp"
#include "lang/math/random.hpp"
#include "lang/object/object.hpp"
#include "render/math/color.hpp"
#include "render/math/power_of_two.hpp"
#include "render/math/vec3.hpp"

namespace sdlc::lang {
namespace {

using render::LinearRgb;
using render::Vec3;

constexpr std::size_t kAnyNumber = static_cast<std::size_t>(-1);

Computed wrong_argument(const BuiltinCall& call, std::size_t i, std::string_view wanted) {
  call.sink.report(diag::wrong_argument, call.place(i), call.name, wanted,
                   describe(call.arguments[i]));
  return Failed{};
}

template <typename T>
const T* argument(const BuiltinCall& call, std::size_t i) noexcept {
  return std::get_if<T>(&call.arguments[i]);
}

Computed no_result(const BuiltinCall& call, std::string_view argument) {
  call.sink.report(diag::no_real_result, call.where(), call.name, argument);
  return Failed{};
}

/// A number that has no unit, or every number where the unit is kept.
Computed finite(const BuiltinCall& call, Scalar result) {
  if (std::isfinite(result.value)) return result;
  call.sink.report(diag::overflow, call.where(), call.name);
  return Failed{};
}

// Of one number

template <double (*function)(double) noexcept>
Computed keeping_unit(const BuiltinCall& call) {
  const auto* x = argument<Scalar>(call, 0);
  if (x == nullptr) return wrong_argument(call, 0, "a number");
  return Scalar{function(x->value), x->unit};
}

double absolute(double x) noexcept { return std::fabs(x); }
double round_down(double x) noexcept { return std::floor(x); }
double round_up(double x) noexcept { return std::ceil(x); }

Computed evaluate_abs(const BuiltinCall& call) {
  if (const auto* angle = argument<Angle>(call, 0)) return Angle{std::fabs(angle->degrees)};
  return keeping_unit<absolute>(call);
}

Computed evaluate_sqrt(const BuiltinCall& call) {
  const auto* x = argument<Scalar>(call, 0);
  if (x == nullptr) return wrong_argument(call, 0, "a number");
  if (x->value < 0) return no_result(call, "a negative number");
  return Scalar{std::sqrt(x->value)};
}

Computed evaluate_exp(const BuiltinCall& call) {
  const auto* x = argument<Scalar>(call, 0);
  return x == nullptr ? wrong_argument(call, 0, "a number") : finite(call, {exp(x->value)});
}

Computed evaluate_log(const BuiltinCall& call) {
  const auto* x = argument<Scalar>(call, 0);
  if (x == nullptr) return wrong_argument(call, 0, "a number");
  const std::optional<double> result = log(x->value);
  return result ? Computed(Scalar{*result}) : no_result(call, "a number that is not positive");
}

// Trigonometry: angles in, or angles out

template <double (*function)(double) noexcept>
Computed of_angle(const BuiltinCall& call) {
  const auto* x = argument<Angle>(call, 0);
  return x == nullptr ? wrong_argument(call, 0, "an angle") : Scalar{function(x->degrees)};
}

Computed evaluate_tan(const BuiltinCall& call) {
  const auto* x = argument<Angle>(call, 0);
  if (x == nullptr) return wrong_argument(call, 0, "an angle");
  const std::optional<double> result = tan_degrees(x->degrees);
  return result ? Computed(Scalar{*result}) : no_result(call, "an odd multiple of 90deg");
}

template <std::optional<double> (*function)(double) noexcept>
Computed arc(const BuiltinCall& call) {
  const auto* x = argument<Scalar>(call, 0);
  if (x == nullptr || x->unit != Unit::None) return wrong_argument(call, 0, "a number");
  const std::optional<double> result = function(x->value);
  return result ? Computed(Angle{*result}) : no_result(call, "a number beyond -1 and 1");
}

Computed evaluate_atan2(const BuiltinCall& call) {
  const auto *y = argument<Scalar>(call, 0), *x = argument<Scalar>(call, 1);
  if (y == nullptr) return wrong_argument(call, 0, "a number");
  if (x == nullptr) return wrong_argument(call, 1, "a number");
  const std::optional<double> result = atan2_degrees(y->value, x->value);
  return result ? Computed(Angle{*result}) : no_result(call, "0, 0");
}

// Of several values of one type

/// The arguments, or the elements of the list that is the only one; nothing when they are not all
/// numbers or not all angles, which is reported.
std::optional<std::vector<Computed>> comparable_values(const BuiltinCall& call) {
  std::vector<Computed> values(call.arguments.begin(), call.arguments.end());
  const auto* list = values.size() == 1 ? std::get_if<ListValue>(&values[0]) : nullptr;
  if (list != nullptr) {
    const ListValue elements = *list;
    values.clear();
    for (std::size_t i = 0; i < elements.size(); ++i) values.push_back(elements[i]);
  }
  for (std::size_t i = 0; i < values.size(); ++i) {
    const bool is_ordered =
        std::holds_alternative<Scalar>(values[i]) || std::holds_alternative<Angle>(values[i]);
    if (is_ordered && are_of_one_type(values[0], values[i])) continue;
    wrong_argument(call, list != nullptr ? 0 : i, "numbers, or angles, of one unit");
    return std::nullopt;
  }
  if (!values.empty()) return values;
  no_result(call, "an empty list");
  return std::nullopt;
}

bool is_less(const Computed& a, const Computed& b) {
  if (const auto* x = std::get_if<Scalar>(&a)) return x->value < std::get<Scalar>(b).value;
  return std::get<Angle>(a).degrees < std::get<Angle>(b).degrees;
}

Computed evaluate_min(const BuiltinCall& call) {
  const auto values = comparable_values(call);
  if (!values) return Failed{};
  return *std::min_element(values->begin(), values->end(), is_less);
}

Computed evaluate_max(const BuiltinCall& call) {
  const auto values = comparable_values(call);
  if (!values) return Failed{};
  return *std::max_element(values->begin(), values->end(), is_less);
}

Computed evaluate_clamp(const BuiltinCall& call) {
  const auto values = comparable_values(call);
  if (!values) return Failed{};
  if (is_less((*values)[2], (*values)[1])) return no_result(call, "a low end above the high one");
  return std::clamp((*values)[0], (*values)[1], (*values)[2], is_less);
}

Computed evaluate_mod(const BuiltinCall& call) {
  const auto values = comparable_values(call);
  if (!values) return Failed{};
  const auto* a = std::get_if<Scalar>(values->data());
  const double x = a != nullptr ? a->value : std::get<Angle>((*values)[0]).degrees;
  const double y =
      a != nullptr ? std::get<Scalar>((*values)[1]).value : std::get<Angle>((*values)[1]).degrees;
  const std::optional<double> result = modulo(x, y);
  if (!result) {
    call.sink.report(diag::division_by_zero, call.where());
    return Failed{};
  }
  if (a != nullptr) return Scalar{*result, a->unit};
  return Angle{*result};
}

// Lists and strings

Computed evaluate_sum(const BuiltinCall& call) {
  const auto* list = argument<ListValue>(call, 0);
  if (list == nullptr) return wrong_argument(call, 0, "a list of numbers");
  Scalar sum;
  for (std::size_t i = 0; i < list->size(); ++i) {
    const Computed element = (*list)[i];
    const auto* number = std::get_if<Scalar>(&element);
    if (number == nullptr) return wrong_argument(call, 0, "a list of numbers");
    sum.value += number->value;
    if (sum.unit == Unit::None) sum.unit = number->unit;
  }
  return finite(call, sum);
}

Computed evaluate_len(const BuiltinCall& call) {
  const auto* list = argument<ListValue>(call, 0);
  if (list == nullptr) return wrong_argument(call, 0, "a list");
  return Scalar{static_cast<double>(list->size())};
}

Computed evaluate_str(const BuiltinCall& call) {
  if (const auto* x = argument<Scalar>(call, 0)) return to_text(x->value);
  if (const auto* flag = argument<bool>(call, 0)) return std::string(*flag ? "true" : "false");
  if (const auto* text = argument<std::string>(call, 0)) return *text;
  return wrong_argument(call, 0, "a number, true or false, or a string");
}

Computed evaluate_range(const BuiltinCall& call) {
  std::array<double, 3> numbers{0, 0, 1};
  for (std::size_t i = 0; i < call.arguments.size(); ++i) {
    const auto* x = argument<Scalar>(call, i);
    if (x == nullptr || x->unit != Unit::None) return wrong_argument(call, i, "a whole number");
    if (x->value != std::floor(x->value) || std::fabs(x->value) > 0x1p53) {
      call.sink.report(diag::not_whole, call.place(i), call.name, to_text(x->value))
          .help("round it with `floor(…)` or `round(…)`");
      return Failed{};
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

Computed evaluate_dot(const BuiltinCall& call) {
  const auto *a = argument<Triple>(call, 0), *b = argument<Triple>(call, 1);
  if (a == nullptr) return wrong_argument(call, 0, "a vector");
  if (b == nullptr) return wrong_argument(call, 1, "a vector");
  return finite(call, {dot(a->value, b->value)});
}

Computed evaluate_cross(const BuiltinCall& call) {
  const auto *a = argument<Triple>(call, 0), *b = argument<Triple>(call, 1);
  if (a == nullptr) return wrong_argument(call, 0, "a vector");
  if (b == nullptr) return wrong_argument(call, 1, "a vector");
  const Vec3 result = cross(a->value, b->value);
  if (is_finite(result)) return Triple{result};
  call.sink.report(diag::overflow, call.where(), call.name);
  return Failed{};
}

/// The length without overflow on the way.
double length_of(Vec3 v) noexcept {
  if (v == Vec3{}) return 0;
  const int e = render::exponent_of(max_abs(v));
  return std::ldexp(render::length(render::scaled_by_power_of_two(v, -e)), e);
}

Computed evaluate_length(const BuiltinCall& call) {
  const auto* v = argument<Triple>(call, 0);
  return v == nullptr ? wrong_argument(call, 0, "a vector")
                      : finite(call, {length_of(v->value), v->unit});
}

Computed evaluate_normalize(const BuiltinCall& call) {
  const auto* v = argument<Triple>(call, 0);
  if (v == nullptr) return wrong_argument(call, 0, "a vector");
  if (v->value == Vec3{}) return no_result(call, "the zero vector");
  return Triple{render::unit(render::with_moderate_length(v->value))};
}

Computed evaluate_mix(const BuiltinCall& call) {
  const auto* t = argument<Scalar>(call, 2);
  if (t == nullptr || t->unit != Unit::None) return wrong_argument(call, 2, "a number");
  if (!are_of_one_type(call.arguments[0], call.arguments[1])) {
    call.sink.report(diag::different_types, call.place(1), describe(call.arguments[0]),
                     describe(call.arguments[1]));
    return Failed{};
  }
  const auto mixed = [&](auto a, auto b) { return a * (1 - t->value) + b * t->value; };
  if (const auto* a = argument<Scalar>(call, 0)) {
    const auto* b = argument<Scalar>(call, 1);
    return finite(call, {mixed(a->value, b->value), a->unit == Unit::None ? b->unit : a->unit});
  }
  if (const auto* a = argument<Triple>(call, 0)) {
    return Triple{mixed(a->value, argument<Triple>(call, 1)->value), a->unit};
  }
  if (const auto* a = argument<Angle>(call, 0)) {
    return Angle{mixed(a->degrees, argument<Angle>(call, 1)->degrees)};
  }
  if (const auto* a = argument<LinearRgb>(call, 0)) return mixed(*a, *argument<LinearRgb>(call, 1));
  return wrong_argument(call, 0, "two numbers, vectors, angles or colours");
}

// Randomness

Computed evaluate_random(const BuiltinCall& call) {
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

Computed evaluate_noise(const BuiltinCall& call) {
  const auto* p = argument<Triple>(call, 0);
  return p == nullptr ? wrong_argument(call, 0, "a vector") : Scalar{noise(p->value)};
}

constexpr auto kBuiltins = std::to_array<Builtin>({
    {"sqrt", "sqrt(x)", 1, 1, evaluate_sqrt, "Square root of a number that is not negative."},
    {"abs", "abs(x)", 1, 1, evaluate_abs, "Without its sign."},
    {"min", "min(a, b, …)", 1, kAnyNumber, evaluate_min,
     "The least of the arguments, or of a list."},
    {"max", "max(a, b, …)", 1, kAnyNumber, evaluate_max,
     "The greatest of the arguments, or of a list."},
    {"clamp", "clamp(x, low, high)", 3, 3, evaluate_clamp, "x, but not below low nor above high."},
    {"floor", "floor(x)", 1, 1, keeping_unit<round_down>, "The next whole number below."},
    {"ceil", "ceil(x)", 1, 1, keeping_unit<round_up>, "The next whole number above."},
    {"round", "round(x)", 1, 1, keeping_unit<round_half_away>,
     "The nearest whole number, of two the one farther from 0."},
    {"exp", "exp(x)", 1, 1, evaluate_exp, "e to the power of x."},
    {"log", "log(x)", 1, 1, evaluate_log, "The natural logarithm of a positive number."},
    {"sin", "sin(angle)", 1, 1, of_angle<sin_degrees>, "Sine."},
    {"cos", "cos(angle)", 1, 1, of_angle<cos_degrees>, "Cosine."},
    {"tan", "tan(angle)", 1, 1, evaluate_tan, "Tangent."},
    {"asin", "asin(x)", 1, 1, arc<asin_degrees>,
     "The angle between -90deg and 90deg whose sine is x."},
    {"acos", "acos(x)", 1, 1, arc<acos_degrees>,
     "The angle between 0deg and 180deg whose cosine is x."},
    {"atan2", "atan2(y, x)", 2, 2, evaluate_atan2,
     "The angle from the x axis to the point (x, y)."},
    {"mod", "mod(a, b)", 2, 2, evaluate_mod,
     "What is left of a after whole multiples of b, with b's sign."},
    {"sum", "sum(list)", 1, 1, evaluate_sum, "The sum of a list of numbers."},
    {"len", "len(list)", 1, 1, evaluate_len, "How many elements a list has."},
    {"str", "str(x)", 1, 1, evaluate_str, "The shortest text that reads back as the same value."},
    {"dot", "dot(a, b)", 2, 2, evaluate_dot, "Inner product of two vectors."},
    {"cross", "cross(a, b)", 2, 2, evaluate_cross, "Vector product, right-handed."},
    {"length", "length(v)", 1, 1, evaluate_length, "Length of a vector."},
    {"normalize", "normalize(v)", 1, 1, evaluate_normalize,
     "The vector of length 1 in v's direction."},
    {"mix", "mix(a, b, t)", 3, 3, evaluate_mix, "a (1 - t) + b t; colours are mixed as light."},
    {"random", "random(a, …)", 1, kAnyNumber, evaluate_random,
     "Uniform in [0, 1): the same arguments give the same number."},
    {"noise", "noise(p)", 1, 1, evaluate_noise, "Smooth noise between -1 and 1, in space."},
    {"range", "range(n), range(a, b), range(a, b, step)", 1, 3, evaluate_range,
     "The whole numbers from 0 or a up to, and without, n or b."},
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
