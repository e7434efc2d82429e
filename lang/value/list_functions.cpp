#include <array>
#include <cmath>

#include "lang/value/arithmetic.hpp"
#include "lang/value/builtin_call.hpp"
#include "lang/value/builtin_tables.hpp"

namespace sdlc::lang {
namespace {

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

constexpr auto kListFunctions = std::to_array<Builtin>({
    {"sum", "sum(list)", 1, 1, evaluate_sum, "list", "", "lists",
     "The sum of a list of numbers, points, angles or colours."},
    {"len", "len(list)", 1, 1, evaluate_len, "list", "number", "lists",
     "The number of elements of a list.", 0},
    {"range", "range(n), range(a, b), range(a, b, step)", 1, 3, evaluate_range, "number", "list",
     "lists",
     "The whole numbers from 0 to `n - 1`, or from `a` in steps of `step` (default 1) before `b`."},
});

}  // namespace

std::span<const Builtin> list_functions() noexcept { return kListFunctions; }

}  // namespace sdlc::lang
