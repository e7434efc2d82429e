#include <algorithm>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "lang/eval/evaluator.hpp"
#include "lang/source/limits.hpp"
#include "lang/value/element_type.hpp"
#include "lang/value/logic.hpp"

// The names of loops, and comprehensions.
namespace sdlc::lang {

bool Evaluator::bind_names(const Loop& loop, std::size_t i) {
  Varying* variables = &locals_[frame_ + loop.names.slot];
  const bool is_plain =
      !loop.names.has_index && loop.names.part_count == 0 && loop.closing == nullptr;
  if (is_plain) {  // fast path
    variables->values[0] = loop.opening[i];
    variables->reads_time = loop.reads_time;
    variables->varies = false;
    return true;
  }
  if (loop.names.has_index) *variables++ = {.values = {Scalar{static_cast<double>(i)}}};
  const std::size_t moments = loop.closing != nullptr ? 2 : 1;
  const std::size_t count = std::max<std::size_t>(loop.names.part_count, 1);
  for (Varying& variable : std::span(variables, count)) {
    variable.reads_time = loop.reads_time;
    variable.varies = moments == 2;
  }
  for (std::size_t moment = 0; moment < moments; ++moment) {
    Value element = (moment == 0 ? loop.opening : *loop.closing)[i];
    if (loop.names.part_count == 0) {
      variables->values[moment] = std::move(element);
      continue;
    }
    const ListValue* parts = elements_of(element);
    const bool is_good = parts != nullptr && parts->size() == count;
    for (std::size_t k = 0; k < count; ++k) {
      variables[k].values[moment] = is_good ? (*parts)[k] : Nothing{};
    }
    if (!is_good) return report_wrong_parts(loop, element);
  }
  return true;
}

bool Evaluator::report_wrong_parts(const Loop& loop, const Value& element) {
  const ast::Node pattern = *ast::Node(*loop.code.tree, loop.node).first(SyntaxKind::Pattern);
  const ast::Node names = *pattern.first(SyntaxKind::RowPattern);
  const ListValue* parts = elements_of(element);
  const auto count = [](std::size_t size) {
    return fmt::format("a list of {} element{}", size, size == 1 ? "" : "s");
  };
  auto report =
      sink_.report(diag::wrong_parts, names.location(), names.text(), count(loop.names.part_count),
                   parts != nullptr ? count(parts->size()) : std::string(describe(element)));
  report.label(place(loop.code, loop.list), "an element of this");
  if (holds_alternative<Triple>(element)) report.help("its components are `.x`, `.y` and `.z`");
  return false;
}

/// A comprehension and its elements so far.
struct Evaluator::Comprehension {
  const Code& code;
  NodeIndex node;
  std::uint32_t value;                     ///< expression of an element
  std::span<const std::uint32_t> clauses;  ///< expressions
  std::vector<double> numbers = {};        ///< the elements while all are numbers of one unit
  Unit unit = Unit::None;
  std::vector<Value> elements = {};  ///< otherwise
  ElementType type = {};             ///< of the elements
  CountedBytes bytes = {};
};

Value Evaluator::evaluate_comprehension(const Code& code, const Expression& e) {
  if (!take_steps(code, e.node, work::kList)) return Nothing{};
  const auto operands = code.operands_of(e);
  Comprehension list{
      .code = code, .node = e.node, .value = operands[0], .clauses = operands.subspan(1)};
  if (!run_clauses(list, 0)) return Nothing{};
  list.bytes.set(0);  // the list counts them
  if (!list.numbers.empty()) return ListValue(std::move(list.numbers), list.unit);
  return ListValue(std::move(list.elements));
}

bool Evaluator::run_clauses(Comprehension& list, std::size_t first) {
  if (first == list.clauses.size()) return add_element(list);
  const std::uint32_t index = list.clauses[first];
  const Expression& clause = list.code.expressions[index];
  bool is_good = false;
  if (StackSegments::is_low()) [[unlikely]] {
    run_on_segment(list.code, clause.node, [&] { is_good = run_clauses(list, first); });
    return is_good;
  }
  if (clause.op == Op::ForClause) {
    is_good = run_for_clause(list, first);
  } else if (clause.op == Op::IfClause) {
    const auto holds = evaluate_condition(list.code, list.code.operands_of(clause)[0], "if");
    is_good = holds && (!*holds || run_clauses(list, first + 1));
  } else {
    evaluate(list.code, index);  // a broken one
  }
  return is_good;
}

bool Evaluator::run_for_clause(Comprehension& list, std::size_t index) {
  const Code& code = list.code;
  const Expression& clause = code.expressions[list.clauses[index]];
  const auto operands = code.operands_of(clause);
  const std::uint32_t expression = operands[LoopSlots::kOperands];
  const Value value = evaluate(code, expression);
  if (is_nothing(value)) return false;
  const auto* elements = get_if<ListValue>(&value);
  if (elements == nullptr) {
    report_not_a_list(code, expression, value);
    return false;
  }
  const bool is_last = index + 1 == list.clauses.size();
  const bool has_room =
      !is_last || (list.elements.empty() ? make_room(list, list.numbers, elements->size())
                                         : make_room(list, list.elements, elements->size()));
  if (!has_room) return false;

  // The comprehension is evaluated at one moment: only the statements around it know two.
  const Loop loop{.code = code,
                  .node = clause.node,
                  .names = LoopSlots(operands),
                  .list = expression,
                  .opening = *elements};
  const Nested entry(*this, {.kind = StackEntry::Iteration,
                             .code = &code,
                             .node = clause.node,
                             .local = frame_ + loop.names.slot});
  const std::size_t entry_index = stack_.size() - 1;
  for (std::size_t i = 0; i < elements->size(); ++i) {
    stack_[entry_index].iteration = i;
    const bool is_good = take_steps(code, clause.node, work::kTurn + loop.names.part_count) &&
                         bind_names(loop, i) && run_clauses(list, index + 1);
    if (!is_good) return false;
  }
  return true;
}

bool Evaluator::add_element(Comprehension& list) {
  Value value;
  const Scalar number = evaluate_number(list.code, list.value, value);
  if (!is_number(number)) return add_value(list, std::move(value));
  const bool is_compact =
      list.elements.empty() && (list.numbers.empty() || list.unit == number.unit);
  if (!is_compact) return add_value(list, number);
  const bool is_full = list.numbers.size() == list.numbers.capacity();
  if (is_full && !make_room(list, list.numbers, 1)) return false;
  list.unit = number.unit;
  list.numbers.push_back(number.value);
  return true;
}

bool Evaluator::add_value(Comprehension& list, Value value) {
  if (is_nothing(value) || !take_steps(list.code, list.node, steps_to_compare(value))) return false;
  if (list.elements.empty()) {
    const std::size_t room = std::max(list.numbers.capacity(), list.numbers.size() + 1);
    if (!make_room(list, list.elements, room)) return false;
    for (const double number : list.numbers) list.elements.push_back(Scalar{number, list.unit});
    if (!list.elements.empty()) list.type.admit(list.elements.front());
    list.numbers = {};
  }
  if (!list.type.admit(value)) return report_mixed_element(list, value);
  const bool is_full = list.elements.size() == list.elements.capacity();
  if (is_full && !make_room(list, list.elements, 1)) return false;
  list.elements.push_back(std::move(value));
  return true;
}

bool Evaluator::report_mixed_element(const Comprehension& list, const Value& value) {
  const auto other = std::ranges::find_if_not(
      list.elements, [&](const Value& element) { return are_of_one_type(element, value); });
  auto report = sink_.report(diag::mixed_list, place(list.code, list.value), describe(*other),
                             describe(value));
  const ListValue *row = elements_of(*other), *other_row = elements_of(value);
  report.help(
      row != nullptr && other_row != nullptr
          ? describe_difference(*row, *other_row)
          : fmt::format("element {} is {}", other - list.elements.begin(), describe(*other)));
  return false;
}

template <typename T>
bool Evaluator::make_room(Comprehension& list, std::vector<T>& elements, std::size_t count) {
  const std::size_t size = elements.size() + count;
  if (size <= elements.capacity()) return true;
  const std::size_t capacity = std::max(size, 2 * elements.capacity());
  if (!may_take_memory(list.code, list.node, capacity * sizeof(T))) return false;
  elements.reserve(capacity);
  list.bytes.set(capacity * sizeof(T));
  return true;
}

}  // namespace sdlc::lang
