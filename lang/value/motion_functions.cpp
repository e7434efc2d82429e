#include <array>
#include <cmath>
#include <string>

#include "lang/math/easing.hpp"
#include "lang/value/builtin_call.hpp"
#include "lang/value/builtin_tables.hpp"

namespace sdlc::lang {
namespace {

constexpr auto kCurveOption = std::to_array<Property>({
    {.name = "curve",
     .type = Type::Word,
     .default_value = std::string_view("cubic"),
     .default_text = "cubic",
     .words = kEaseCurveNames,
     .doc = "The shape of the transition from 0 to 1."},
});

Value evaluate_smoothstep(const BuiltinCall& call) {
  constexpr std::size_t kX = 2;
  const std::optional<double> share = share_of_interval(call, kX, 0);
  if (!share) return Nothing{};
  const double t = std::fmin(std::fmax(*share, 0), 1);
  return Scalar{t * t * (3 - 2 * t)};
}

Value wrong_share(const BuiltinCall& call) {
  const Value& share = call.arguments[0];
  const auto* number = get_if<Scalar>(&share);
  const bool is_time = number != nullptr && number->unit == Unit::Time;
  call.sink
      .report(diag::wrong_argument, call.place(0), call.function.name, "a number from 0 to 1",
              describe(share))
      .help_if(is_time ? "divide it by the duration of the motion: `time / 2s`" : "");
  return Nothing{};
}

template <double (*ease)(EaseCurve, double) noexcept>
Value eased(const BuiltinCall& call) {
  const auto* t = plain_number(call, 0);
  if (t == nullptr) return wrong_share(call);
  return Scalar{ease(find_ease_curve(get<Word>(call.options[0]).text), t->value)};
}

constexpr auto kMotionFunctions = std::to_array<Builtin>({
    {"smoothstep", "smoothstep(low, high, x)", 3, 3, evaluate_smoothstep, "number", "number",
     "motion",
     "From 0 at `low` to 1 at `high` with a slope of 0 at both: `3 * t^2 - 2 * t^3`; also for "
     "angles."},
    {.name = "ease_in",
     .signature = "ease_in(t, curve: cubic)",
     .min_arguments = 1,
     .max_arguments = 1,
     .evaluate = eased<ease_in>,
     .takes = "number",
     .result = "number",
     .topic = "motion",
     .doc = "From 0 at `t` = 0 to 1 at `t` = 1, slow at the beginning.",
     .steps = 100,
     .options = kCurveOption},
    {.name = "ease_out",
     .signature = "ease_out(t, curve: cubic)",
     .min_arguments = 1,
     .max_arguments = 1,
     .evaluate = eased<ease_out>,
     .takes = "number",
     .result = "number",
     .topic = "motion",
     .doc = "The same, slow at the end: `1 - ease_in(1 - t)`.",
     .steps = 100,
     .options = kCurveOption},
    {.name = "ease_in_out",
     .signature = "ease_in_out(t, curve: cubic)",
     .min_arguments = 1,
     .max_arguments = 1,
     .evaluate = eased<ease_in_out>,
     .takes = "number",
     .result = "number",
     .topic = "motion",
     .doc = "The same, slow at both ends: `ease_in` to the middle, then `ease_out`.",
     .steps = 100,
     .options = kCurveOption},
});

}  // namespace

std::span<const Builtin> motion_functions() noexcept { return kMotionFunctions; }

}  // namespace sdlc::lang
