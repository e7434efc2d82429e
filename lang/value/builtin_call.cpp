#include "lang/value/builtin_call.hpp"

#include <array>

#include "lang/value/arithmetic.hpp"
#include "lang/value/logic.hpp"

namespace sdlc::lang {

Value wrong_argument(const BuiltinCall& call, std::size_t i, std::string_view wanted) {
  const Location where = call.place(i);
  const auto* row = argument<RowValue>(call, i);
  if (row != nullptr && wanted == kListWanted) {
    report_mixed(*row, where, call.sink);
    return Nothing{};
  }
  auto report = call.sink.report(diag::wrong_argument, where, call.function.name, wanted,
                                 describe(call.arguments[i]));
  const bool is_literal = call.node.child(i)->is(SyntaxKind::Number);
  if (wanted == kAngleWanted && is_literal && holds_alternative<Scalar>(call.arguments[i])) {
    report.unsafe_fix({where.file, {where.span.end, where.span.end}}, "deg");
  } else if (wanted == kAngleWanted && holds_alternative<Scalar>(call.arguments[i])) {
    report.help("multiply a number by `1deg` to get an angle: `x * 1deg`");
  }
  return Nothing{};
}

Value no_result(const BuiltinCall& call, std::string_view argument) {
  call.sink.report(diag::no_real_result, call.where(), call.function.name, argument);
  return Nothing{};
}

namespace {

/// The number of an angle or a number.
std::optional<double> ordered_number(const Value& value) noexcept {
  if (const auto* angle = get_if<Angle>(&value)) return angle->degrees;
  return value_as<double>(value);
}

}  // namespace

std::optional<double> share_of_interval(const BuiltinCall& call, std::size_t x, std::size_t low) {
  std::array<double, 3> numbers{};
  const std::array<std::size_t, 3> places{x, low, low + 1};
  for (const std::size_t i : {0, 1, 2}) {
    const Value& value = call.arguments[places[i]];
    const auto number = ordered_number(value);
    if (!number || !are_of_one_type(call.arguments[x], value) ||
        !are_of_one_type(call.arguments[low], value)) {
      wrong_argument(call, places[i], "numbers of one unit or angles");
      return std::nullopt;
    }
    numbers[i] = *number;
  }
  // Halves, so that no difference overflows.
  const double from = numbers[1] / 2, width = numbers[2] / 2 - from;
  if (width == 0) {
    no_result(call, "an interval whose ends are equal");
    return std::nullopt;
  }
  return (numbers[0] / 2 - from) / width;
}

Value finite(const BuiltinCall& call, Value result) {
  if (is_finite(result)) return result;
  call.sink.report(diag::overflow, call.where(), call.function.name);
  return Nothing{};
}

}  // namespace sdlc::lang
