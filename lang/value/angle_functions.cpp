#include <optional>

#include "lang/math/elementary.hpp"
#include "lang/value/builtin_call.hpp"
#include "lang/value/builtin_tables.hpp"

namespace sdlc::lang {
namespace {

template <double (*function)(double) noexcept>
Value of_angle(const BuiltinCall& call) {
  const auto* x = argument<Angle>(call, 0);
  return x == nullptr ? wrong_argument(call, 0, kAngleWanted) : Scalar{function(x->degrees)};
}

Value evaluate_tan(const BuiltinCall& call) {
  const auto* x = argument<Angle>(call, 0);
  if (x == nullptr) return wrong_argument(call, 0, kAngleWanted);
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

constexpr auto kAngleFunctions = std::to_array<Builtin>({
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
});

}  // namespace

std::span<const Builtin> angle_functions() noexcept { return kAngleFunctions; }

}  // namespace sdlc::lang
