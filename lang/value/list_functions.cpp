#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "lang/source/limits.hpp"
#include "lang/value/arithmetic.hpp"
#include "lang/value/builtin_call.hpp"
#include "lang/value/builtin_tables.hpp"
#include "lang/value/element_type.hpp"
#include "lang/value/logic.hpp"

namespace sdlc::lang {
namespace {

Value evaluate_sum(const BuiltinCall& call) {
  const auto* list = argument<ListValue>(call, 0);
  if (list == nullptr) return wrong_argument(call, 0, kListWanted);
  if (list->size() == 0) return Scalar{};
  Value sum = (*list)[0];
  const ast::Node place = *call.node.child(0);
  for (std::size_t i = 1; i < list->size() && !is_nothing(sum); ++i) {
    sum = evaluate_operation(sum, Operator::Add, (*list)[i], {place, place}, call.sink);
  }
  return sum;
}

Value evaluate_len(const BuiltinCall& call) {
  const ListValue* list = elements_of(call.arguments[0]);
  if (list == nullptr) return wrong_argument(call, 0, kListWanted);
  return Scalar{static_cast<double>(list->size())};
}

std::uint64_t size_of(const Value& value) noexcept {
  const auto* list = get_if<ListValue>(&value);
  return list == nullptr ? 0 : list->size();
}

BuiltinWork work_of_copy(const BuiltinCall& call) {
  return {.bytes = size_of(call.arguments[0]) * sizeof(Value)};
}

Value evaluate_reverse(const BuiltinCall& call) {
  const auto* list = argument<ListValue>(call, 0);
  if (list == nullptr) return wrong_argument(call, 0, kListWanted);
  std::vector<Value> values;
  values.reserve(list->size());
  for (std::size_t i = list->size(); i-- > 0;) values.push_back((*list)[i]);
  return ListValue(std::move(values));
}

/// Reports a list whose elements have the wrong type.
Value wrong_element(const BuiltinCall& call, std::size_t i, std::string_view wanted,
                    const Value& element, std::string_view help = {}) {
  call.sink
      .report(diag::wrong_argument, call.place(i), call.function.name, wanted,
              fmt::format("a list with {}", describe(element)))
      .help_if(help);
  return Nothing{};
}

template <bool (*stops_at)(bool)>
Value any_or_all(const BuiltinCall& call) {
  const auto* list = argument<ListValue>(call, 0);
  if (list == nullptr) return wrong_argument(call, 0, kListWanted);
  bool result = !stops_at(true);
  for (std::size_t i = 0; i < list->size(); ++i) {
    const auto value = value_as<bool>((*list)[i]);
    if (!value) return wrong_element(call, 0, "a list of truth values", (*list)[i]);
    if (stops_at(*value)) result = *value;
  }
  return result;
}

bool is_true(bool value) { return value; }
bool is_false(bool value) { return !value; }

// sort

/// The key of an element: a number, an angle in degrees, or a text.
template <typename Key>
struct Keyed {
  Key key;
  std::size_t index;
};

/// A merge sort compares each element once per level; strings are compared as far as they agree.
BuiltinWork work_of_sort(const BuiltinCall& call) {
  const std::uint64_t size = size_of(call.arguments[0]);
  const auto* keys = argument<ListValue>(call, call.arguments.size() - 1);
  const std::uint64_t levels = static_cast<std::uint64_t>(std::bit_width(size));
  const std::uint64_t weight = keys == nullptr ? 0 : keys->weight();
  constexpr std::uint64_t kMaxWeight = std::uint64_t{1} << 56;
  return {.steps = std::min(weight, kMaxWeight) * levels,
          .bytes = size * (sizeof(Value) + 2 * sizeof(Keyed<std::string>))};
}

/// nullopt if the values are not all a T.
template <typename T, typename Key>
std::optional<std::vector<Keyed<Key>>> keys_of(const ListValue& list, Key (*key_of)(const T&)) {
  std::vector<Keyed<Key>> keys;
  keys.reserve(list.size());
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Value value = list[i];
    const auto* key = get_if<T>(&value);
    if (key == nullptr) return std::nullopt;
    keys.push_back({key_of(*key), i});
  }
  return keys;
}

double number_of(const Scalar& number) { return number.value; }
double degrees_of(const Angle& angle) { return angle.degrees; }

std::string text_of(const std::string& text) { return text; }

template <typename Key>
Value in_order(const ListValue& list, std::vector<Keyed<Key>> keys) {
  std::ranges::stable_sort(keys, {}, &Keyed<Key>::key);
  std::vector<Value> values;
  values.reserve(keys.size());
  for (const Keyed<Key>& key : keys) values.push_back(list[key.index]);
  return ListValue(std::move(values));
}

/// Reports lists of different lengths; the `i`-th is not as long as the first one.
Value wrong_length(const BuiltinCall& call, std::size_t i) {
  const std::uint64_t first = size_of(call.arguments[0]), other = size_of(call.arguments[i]);
  call.sink.report(diag::wrong_argument, call.place(i), call.function.name,
                   fmt::format("a list of length {}, like the first one,", first),
                   fmt::format("one of length {}", other));
  return Nothing{};
}

Value evaluate_sort(const BuiltinCall& call) {
  const std::size_t last = call.arguments.size() - 1;
  const auto *list = argument<ListValue>(call, 0), *keys = argument<ListValue>(call, last);
  if (list == nullptr) return wrong_argument(call, 0, kListWanted);
  if (keys == nullptr) {
    return wrong_argument(call, last, "a list of keys, such as `[f(x) for x in xs]`,");
  }
  if (keys->size() != list->size()) return wrong_length(call, last);
  if (auto found = keys_of(*keys, number_of)) return in_order(*list, std::move(*found));
  if (auto found = keys_of(*keys, degrees_of)) return in_order(*list, std::move(*found));
  if (auto found = keys_of(*keys, text_of)) return in_order(*list, std::move(*found));
  return wrong_element(
      call, last, "a list of numbers of one unit, angles or strings", (*keys)[0],
      last == 0 ? "give the keys to sort by: `sort(list, [f(x) for x in list])`" : "");
}

// zip

BuiltinWork work_of_zip(const BuiltinCall& call) {
  const std::uint64_t rows = size_of(call.arguments[0]), columns = call.arguments.size();
  constexpr std::uint64_t kRow = 128;  // a list of its own
  return {.steps = rows * (work::kList + columns),
          .bytes = rows * (kRow + columns * sizeof(Value))};
}

Value evaluate_zip(const BuiltinCall& call) {
  const std::size_t columns = call.arguments.size();
  for (std::size_t i = 0; i < columns; ++i) {
    if (argument<ListValue>(call, i) == nullptr) return wrong_argument(call, i, kListWanted);
    if (size_of(call.arguments[i]) != size_of(call.arguments[0])) return wrong_length(call, i);
  }
  std::vector<Value> rows;
  const std::size_t count = size_of(call.arguments[0]);
  rows.reserve(count);
  for (std::size_t row = 0; row < count; ++row) {
    std::vector<Value> values;
    values.reserve(columns);
    ElementType type;
    bool is_mixed = false;
    for (std::size_t i = 0; i < columns; ++i) {
      values.push_back((*argument<ListValue>(call, i))[row]);
      is_mixed = is_mixed || !type.admit(values.back());
    }
    ListValue elements(std::move(values));
    rows.push_back(is_mixed ? Value(RowValue{std::move(elements)}) : Value(std::move(elements)));
  }
  return ListValue(std::move(rows));
}

// range

/// A range of whole numbers: the count is exact.
std::optional<double> count_of_whole(double first, double end, double step) noexcept {
  return std::fmax(0, std::ceil((end - first) / step));
}

/// Of a range with fractions. An end that is reached up to rounding is excluded: within 1e-9 steps,
/// or, after more than a million steps, within 2^-50 of the count.
std::optional<double> count_of_fractions(double first, double end, double step) noexcept {
  const double steps = (end - first) / step;
  if (!(steps < 0x1p53)) return std::nullopt;
  return std::fmax(0, std::ceil(steps - std::fmax(1e-9, std::fabs(steps) * 0x1p-50)));
}

bool is_whole(double x) noexcept { return x == std::floor(x) && std::fabs(x) <= 0x1p53; }

/// The arguments of `range` by their meaning.
struct RangeNumbers {
  double first = 0, end = 0, step = 1;
  Unit unit = Unit::None;
  bool has_angles = false, is_whole = true;
};

/// range(n), range(first, end) or range(first, end, step); nullopt: an error is reported.
std::optional<RangeNumbers> numbers_of_range(const BuiltinCall& call) {
  RangeNumbers range;
  const std::size_t count = call.arguments.size();
  const bool has_step = count == 3;
  for (std::size_t i = 0; i < count; ++i) {
    const Value& value = call.arguments[i];
    const auto* number = get_if<Scalar>(&value);
    const auto* angle = get_if<Angle>(&value);
    const bool is_good = has_step
                             ? (i == 0 || range.has_angles == (angle != nullptr)) &&
                                   (angle != nullptr || number != nullptr) &&
                                   (number == nullptr || are_compatible(range.unit, number->unit))
                             : number != nullptr && number->unit == Unit::None;
    if (!is_good) {
      const bool wants_angle = range.has_angles && number != nullptr;
      wrong_argument(call, i,
                     !has_step     ? "a whole number"
                     : wants_angle ? kAngleWanted
                                   : "numbers of one unit or three angles");
      return std::nullopt;
    }
    range.has_angles = angle != nullptr;
    if (number != nullptr) range.unit = common_unit(range.unit, number->unit);
    const double x = angle != nullptr ? angle->degrees : number->value;
    range.is_whole = range.is_whole && is_whole(x);
    if (!has_step && !is_whole(x)) {
      call.sink.report(diag::not_whole, call.place(i), call.function.name, to_text(x))
          .help(count == 1 ? "round it with `floor(…)` or `round(…)`"
                           : "round it with `floor(…)` or `round(…)`, or give a step: "
                             "`range(a, b, step)`");
      return std::nullopt;
    }
    (count == 1 || i == 1 ? range.end : i == 0 ? range.first : range.step) = x;
  }
  return range;
}

Value evaluate_range(const BuiltinCall& call) {
  const auto range = numbers_of_range(call);
  if (!range) return Nothing{};
  const auto [first, end, step, unit, has_angles, is_whole_range] = *range;
  if (step == 0) return no_result(call, "a step of 0");
  const auto count =
      is_whole_range ? count_of_whole(first, end, step) : count_of_fractions(first, end, step);
  if (!count) return no_result(call, "so small a step");
  // Where sizes have 32 bits, a longer list takes too many steps anyway.
  constexpr auto kMaxSize = static_cast<double>(std::numeric_limits<std::uint32_t>::max());
  const auto size =
      static_cast<std::size_t>(sizeof(std::size_t) < 8 ? std::min(*count, kMaxSize) : *count);
  return has_angles ? ListValue(Angle{first}, step, size)
                    : ListValue(Scalar{first, unit}, step, size);
}

constexpr auto kListFunctions = std::to_array<Builtin>({
    {"sum", "sum(list)", 1, 1, evaluate_sum, "list", "", "lists",
     "The sum of a list of numbers, points, angles or colours."},
    {"len", "len(list)", 1, 1, evaluate_len, "list", "number", "lists",
     "The number of elements of a list or row.", 0},
    {"range", "range(n), range(a, b), range(a, b, step)", 1, 3, evaluate_range, "number", "list",
     "lists",
     "The whole numbers from 0 to `n - 1`, or from `a` in steps of `step` (default 1) before `b`. "
     "With a step, also fractions, lengths, times and angles: `a + i * step` before `b`."},
    {"sort", "sort(list), sort(list, keys)", 1, 2, evaluate_sort, "list", "list", "lists",
     "The elements from the smallest to the largest: numbers, angles, or strings by their code "
     "points. With `keys`, a list of as many, the elements are in the order of their keys. "
     "Elements with equal keys keep their order.",
     20, work_of_sort},
    {"reverse", "reverse(list)", 1, 1, evaluate_reverse, "list", "list", "lists",
     "The elements from the last to the first.", 10, work_of_copy},
    {"zip", "zip(a, b, …)", 2, kAnyNumber, evaluate_zip, "list", "list", "lists",
     "The rows `[a[i], b[i], …]` for each `i`; the arguments are lists of one length.", 10,
     work_of_zip},
    {"any", "any(list)", 1, 1, any_or_all<is_true>, "list", "bool", "lists",
     "Whether a truth value of the list is true; false of an empty list."},
    {"all", "all(list)", 1, 1, any_or_all<is_false>, "list", "bool", "lists",
     "Whether all truth values of the list are true; true of an empty list."},
});

}  // namespace

std::span<const Builtin> list_functions() noexcept { return kListFunctions; }

}  // namespace sdlc::lang
