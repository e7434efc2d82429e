#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lang/eval/evaluator.hpp"
#include "lang/source/limits.hpp"
#include "lang/value/arithmetic.hpp"
#include "lang/value/element_type.hpp"
#include "lang/value/literals.hpp"
#include "lang/value/logic.hpp"

// Names, operators and conditions.
namespace sdlc::lang {
namespace {

constexpr std::uint64_t kPowerSteps = 100, kStringSteps = 4;

}  // namespace

const Value& Evaluator::read(const Varying& variable) {
  if (variable.reads_time) reads_time_ = true;
  return variable.values[variable.varies ? moment_ : 0];
}

const Evaluator::Varying& Evaluator::outer_local(const Environment* environment,
                                                 std::uint32_t outwards, std::uint32_t slot) const {
  for (; outwards > 1; --outwards) environment = environment->outer;
  return locals_[environment->frame + slot];
}

/// `a op b`; kNoNumber if an operand is no number or there is an error to report.
Scalar Evaluator::combine_numbers(Scalar a, Operator op, Scalar b) noexcept {
  // Most operands have no unit: one test for both.
  const bool has_unit = a.unit != Unit::None || b.unit != Unit::None;
  if (has_unit) {
    const bool is_sum = op == Operator::Add || op == Operator::Subtract;
    const bool is_good = is_number(a) && is_number(b) &&
                         (is_sum                     ? are_compatible(a.unit, b.unit)
                          : op == Operator::Multiply ? a.unit == Unit::None || b.unit == Unit::None
                                                     : b.unit == Unit::None);
    if (!is_good) return kNoNumber;
  }
  double result = 0;
  switch (op) {
    case Operator::Add: result = a.value + b.value; break;
    case Operator::Subtract: result = a.value - b.value; break;
    case Operator::Multiply: result = a.value * b.value; break;
    default:
      if (b.value == 0) return kNoNumber;
      result = a.value / b.value;
  }
  return std::isfinite(result) ? Scalar{result, common_unit(a.unit, b.unit)} : kNoNumber;
}

Scalar Evaluator::evaluate_number(const Code& code, std::uint32_t index, Value& other) {
  const Expression& e = code.expressions[index];
  const Value* value = &other;
  switch (e.op) {
    case Op::Number: return {code.numbers[e.first], static_cast<Unit>(e.detail)};
    case Op::Local: value = &read(locals_[frame_ + e.first]); break;
    case Op::Global: {
      const std::uint32_t* operands = code.operands.data() + e.first;
      value = &read(globals_[operands[0]][operands[1]]);
      break;
    }
    case Op::Sum:
    case Op::Product:
      if (StackSegments::is_low()) [[unlikely]] {
        Scalar result = kNoNumber;
        run_on_segment(code, e.node, [&] { result = evaluate_chain(code, e, other); });
        return result;
      }
      return evaluate_chain(code, e, other);
    default: other = evaluate(code, index);
  }
  if (const auto* number = get_if<Scalar>(value)) return *number;
  if (value != &other) other = *value;
  return kNoNumber;
}

Value Evaluator::evaluate(const Code& code, std::uint32_t index) {
  const Expression& e = code.expressions[index];
  switch (e.op) {
    case Op::Number: return Scalar{code.numbers[e.first], static_cast<Unit>(e.detail)};
    case Op::Constant: return code.constants[e.first];
    case Op::Local: return read(locals_[frame_ + e.first]);
    case Op::Outer: return read(outer_local(environment_, e.detail, e.first));
    case Op::Time: reads_time_ = true; return Scalar{times_[moment_], Unit::Time};
    case Op::Global: {
      const auto operands = code.operands_of(e);
      return read(globals_[operands[0]][operands[1]]);
    }
    default: break;
  }
  ++steps_;
  if (StackSegments::is_low()) [[unlikely]] {
    Value value = Nothing{};
    run_on_segment(code, e.node, [&] { value = evaluate_operation(code, e); });
    return value;
  }
  return evaluate_operation(code, e);
}

Value Evaluator::evaluate_operation(const Code& code, const Expression& e) {
  switch (e.op) {
    case Op::Sum:
    case Op::Product: {
      Value other;
      const Scalar number = evaluate_chain(code, e, other);
      return is_number(number) ? Value(number) : other;
    }
    case Op::Power: return evaluate_power(code, e);
    case Op::Builtin: return evaluate_builtin(code, e);
    case Op::Triple: return evaluate_triple(code, e);
    case Op::Constructor: return evaluate_constructor(code, e);
    case Op::Function:
    case Op::LocalFunction: return evaluate_function(code, e);
    case Op::Negative:
      return evaluate_negative(evaluate(code, code.operands_of(e)[0]), location(code, e.node),
                               sink_);
    case Op::Not: {
      const auto operand = evaluate_condition(code, code.operands_of(e)[0], "not");
      return operand ? Value(!*operand) : Nothing{};
    }
    case Op::And:
    case Op::Or: return evaluate_logic(code, e);
    case Op::Comparison: {
      const auto operands = code.operands_of(e);
      const Value left = evaluate(code, operands[0]);
      if (!take_steps(code, e.node, steps_to_read(left))) return Nothing{};
      return evaluate_comparison(left, code.expressions[operands[1]].before,
                                 evaluate(code, operands[1]), location(code, e.node), sink_);
    }
    case Op::Interval: return evaluate_interval(code, e);
    case Op::List: return evaluate_list(code, e);
    case Op::Comprehension: return evaluate_comprehension(code, e);
    case Op::Conditional: return evaluate_conditional(code, e);
    case Op::LetIn: return evaluate_let_in(code, e);
    case Op::Member: return evaluate_member(code, e);
    case Op::Index: return evaluate_index(code, e);
    default:
      for (const std::uint32_t operand : code.operands_of(e)) evaluate(code, operand);
      return Nothing{};
  }
}

std::optional<bool> Evaluator::evaluate_condition(const Code& code, std::uint32_t expression,
                                                  std::string_view word) {
  const Value value = evaluate(code, expression);
  if (const auto* flag = get_if<bool>(&value)) return *flag;
  if (!is_nothing(value)) {
    auto report =
        sink_.report(diag::not_a_condition, place(code, expression), word, describe(value));
    if (holds_alternative<Scalar>(value)) report.help("compare it, as in `x > 0`");
  }
  return std::nullopt;
}

// Arithmetic

Value Evaluator::combine(const Code& code, const Value& left, std::uint32_t left_index,
                         const Value& right, std::uint32_t right_index) {
  const Operator op = code.expressions[right_index].before;
  const auto *list = get_if<ListValue>(&left), *other = get_if<ListValue>(&right);
  if (list != nullptr && other != nullptr && op == Operator::Add) {
    return join(code, *list, *other, right_index);
  }
  const auto* text = get_if<std::string>(&left);
  const auto* more = get_if<std::string>(&right);
  if (text == nullptr || more == nullptr || op != Operator::Add) {
    return lang::evaluate_operation(left, op, right,
                                    {node(code, left_index), node(code, right_index)}, sink_);
  }
  const std::uint64_t bytes = text->size() + more->size();
  const bool is_good =
      check_string_size(bytes, program_.limits(), place(code, right_index), sink_) &&
      take_steps(code, node(code, right_index).index(), kStringSteps + bytes / work::kBytes) &&
      may_take_memory(code, node(code, right_index).index(), bytes);
  return is_good ? Value(*text + *more) : Nothing{};
}

Value Evaluator::join(const Code& code, const ListValue& left, const ListValue& right,
                      std::uint32_t right_index) {
  if (left.size() == 0) return right;
  if (right.size() == 0) return left;
  const NodeIndex where = node(code, right_index).index();
  const std::uint64_t size = left.size() + right.size();
  const bool has_room = take_steps(code, where, work::kList + size) &&
                        may_take_memory(code, where, size * sizeof(Value));
  if (!has_room) return Nothing{};
  std::vector<Value> values;
  values.reserve(size);
  ElementType type;
  bool is_mixed = false;
  for (const ListValue* list : {&left, &right}) {
    for (std::size_t i = 0; i < list->size(); ++i) {
      values.push_back((*list)[i]);
      if (!take_steps(code, where, steps_to_compare(values.back()))) return Nothing{};
      is_mixed = is_mixed || !type.admit(values.back());
    }
  }
  ListValue joined(std::move(values));
  if (!is_mixed) return joined;
  const auto [i, k] = *first_conflict(joined);
  sink_.report(diag::mixed_list, place(code, right_index), describe(joined[i]),
               describe(joined[k]));
  return Nothing{};
}

Value Evaluator::evaluate_power(const Code& code, const Expression& e) {
  const auto operands = code.operands_of(e);
  const Value base = evaluate(code, operands[0]);
  const Value exponent = evaluate(code, operands[1]);
  const auto* power = get_if<Scalar>(&exponent);
  const bool is_product = power != nullptr && (power->value == 2 || power->value == 3);
  if (!is_product) steps_ += kPowerSteps;
  return lang::evaluate_power(base, exponent, {node(code, operands[0]), node(code, operands[1])},
                              sink_);
}

Scalar Evaluator::evaluate_chain(const Code& code, const Expression& e, Value& other) {
  const std::uint32_t* operands = code.operands.data() + e.first;
  steps_ += e.count;
  Scalar left = evaluate_number(code, operands[0], other);
  for (std::uint32_t i = 1; i < e.count; ++i) {
    Value right_other;
    const Scalar right = evaluate_number(code, operands[i], right_other);
    const Scalar result = combine_numbers(left, code.expressions[operands[i]].before, right);
    if (is_number(result)) {
      left = result;
      continue;
    }
    // The operands are not two numbers, or there is an error to report.
    if (is_number(left)) other = left;
    if (is_number(right)) right_other = right;
    other = combine(code, other, operands[i - 1], right_other, operands[i]);
    const auto* number = get_if<Scalar>(&other);
    left = number != nullptr ? *number : kNoNumber;
  }
  return left;
}

Value Evaluator::evaluate_logic(const Code& code, const Expression& e) {
  // Short-circuit evaluation.
  const bool is_and = e.op == Op::And;
  for (const std::uint32_t operand : code.operands_of(e)) {
    const auto value = evaluate_condition(code, operand, is_and ? "and" : "or");
    if (!value) return Nothing{};
    if (*value != is_and) return *value;
  }
  return is_and;
}

Value Evaluator::evaluate_conditional(const Code& code, const Expression& e) {
  const auto operands = code.operands_of(e);
  std::size_t i = 0;
  for (; i + 1 < operands.size(); i += 2) {
    const auto holds = evaluate_condition(code, operands[i], "if");
    if (!holds) return Nothing{};
    if (*holds) return evaluate(code, operands[i + 1]);
  }
  return i < operands.size() ? evaluate(code, operands[i]) : Nothing{};
}

Value Evaluator::evaluate_let_in(const Code& code, const Expression& e) {
  const auto operands = code.operands_of(e);
  std::uint32_t slot = operands[0];
  for (const std::uint32_t value : operands.subspan(1, operands.size() - 2)) {
    Varying local;
    local.values[0] = evaluate(code, value);  // at the current time
    locals_[frame_ + slot++] = std::move(local);
  }
  return evaluate(code, operands.back());
}

}  // namespace sdlc::lang
