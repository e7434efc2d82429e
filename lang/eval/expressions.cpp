#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "lang/eval/evaluator.hpp"
#include "lang/source/limits.hpp"
#include "lang/value/arithmetic.hpp"
#include "lang/value/builtins.hpp"
#include "lang/value/literals.hpp"
#include "lang/value/logic.hpp"

namespace sdlc::lang {
namespace {

constexpr std::uint64_t kPowerSteps = 100, kStringSteps = 4;

/// The steps of reading all of a value.
std::uint64_t steps_to_read(const Value& value) noexcept {
  if (const auto* list = get_if<ListValue>(&value)) return list->weight();
  if (const auto* text = get_if<std::string>(&value)) return text->size() / work::kBytes;
  return 0;
}

/// A Scalar that is no number: no value has this unit.
constexpr Scalar kNoNumber{0, static_cast<Unit>(0xFF)};

bool is_number(Scalar scalar) noexcept { return scalar.unit != kNoNumber.unit; }

bool are_compatible(Unit a, Unit b) noexcept {
  return a == b || a == Unit::None || b == Unit::None;
}

/// `a op b`, the fast path of most expressions; kNoNumber if an operand is no number or there is
/// anything to report.
Scalar combine_numbers(Scalar a, Operator op, Scalar b) noexcept {
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
  const Unit unit = a.unit == Unit::None ? b.unit : a.unit;
  double result = 0;
  switch (op) {
    case Operator::Add: result = a.value + b.value; break;
    case Operator::Subtract: result = a.value - b.value; break;
    case Operator::Multiply: result = a.value * b.value; break;
    default:
      if (b.value == 0) return kNoNumber;
      result = a.value / b.value;
  }
  return std::isfinite(result) ? Scalar{result, unit} : kNoNumber;
}

}  // namespace

const Value& Evaluator::read(const Varying& variable) {
  if (variable.reads_time) reads_time_ = true;
  return variable.values[variable.varies ? moment_ : 0];
}

bool Evaluator::may_nest(const Code& code, NodeIndex node) {
  if (depth_ < kMaxEvaluationDepth) return true;
  sink_.report(diag::too_deep, ast::Node(*code.tree, node).location(), kMaxEvaluationDepth);
  return false;
}

bool Evaluator::may_call(const Code& code, NodeIndex node) {
  // If each call makes two, exponentially many would come here: end the outermost call.
  if (has_called_too_deep_) return false;
  if (calls_ < kMaxCalls) return true;
  has_called_too_deep_ = true;
  sink_.report(diag::too_deep, ast::Node(*code.tree, node).head_location(), kMaxCalls);
  return false;
}

void Evaluator::end_call() {
  if (--calls_ == 0) has_called_too_deep_ = false;
}

bool Evaluator::take_steps(const Code& code, NodeIndex node, std::uint64_t count) {
  if (steps_ <= max_steps_ && count <= max_steps_ - steps_) [[likely]] {
    steps_ += count;
    if (steps_ >= next_poll_) poll();
    return may_take_memory(code, node, 0);
  }
  if (give_up()) {
    sink_
        .report(diag::too_many_steps, ast::Node(*code.tree, node).location(),
                program_.limits().steps)
        .help("`--limit steps=N` allows more");
  }
  return false;
}

void Evaluator::poll() {
  constexpr std::uint64_t kSteps = 1'000;  // a step takes 10 ns, in lists up to a microsecond
  next_poll_ = steps_ + kSteps;
  sink_.stop_if_requested();
}

bool Evaluator::give_up() {
  max_steps_ = 0;
  ++steps_;
  return !std::exchange(has_given_up_, true);
}

std::uint64_t Evaluator::steps() const noexcept {
  return steps_ - std::min(steps_, allowed_steps_);
}

void Evaluator::allow_steps(std::uint64_t spheres) {
  if (objects_->is_full()) give_up();
  if (has_given_up_) return;
  constexpr std::uint64_t kMaxPerSphere = std::uint64_t{1} << 32;  // so that no sum overflows
  const std::uint64_t steps =
      spheres * std::min(program_.limits().steps / work::kSpheres, kMaxPerSphere);
  allowed_steps_ += steps;
  max_steps_ += steps;
}

bool Evaluator::may_take_memory(const Code& code, NodeIndex node, std::uint64_t bytes) {
  const std::uint64_t most = program_.limits().memory, taken = CountedBytes::sum();
  if (taken <= most && bytes <= most - taken) [[likely]]
    return true;
  if (give_up()) {
    sink_.report(diag::too_much_memory, ast::Node(*code.tree, node).location(), most)
        .help("`--limit memory=N` allows more");
  }
  return false;
}

std::optional<std::size_t> Evaluator::open_frame(const Code& code, NodeIndex node,
                                                 std::size_t slots) {
  const std::size_t base = locals_.size(), size = base + slots;
  if (size > locals_.capacity()) {
    const std::size_t capacity = std::max(size, 2 * locals_.capacity());
    if (!may_take_memory(code, node, capacity * sizeof(Varying))) return std::nullopt;
    locals_.reserve(capacity);
    locals_bytes_.set(locals_.capacity() * sizeof(Varying));
  }
  steps_ += slots * work::kSlot;
  locals_.resize(size);
  return base;
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
    case Op::Product: {
      if (!may_nest(code, e.node)) break;
      ++depth_;
      const Scalar result = evaluate_chain(code, e, other);
      --depth_;
      return result;
    }
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
    case Op::Time: reads_time_ = true; return Scalar{times_[moment_], Unit::Time};
    case Op::Global: {
      const auto operands = code.operands_of(e);
      return read(globals_[operands[0]][operands[1]]);
    }
    default: break;
  }
  if (!may_nest(code, e.node)) return Nothing{};
  ++steps_;
  ++depth_;
  Value value = evaluate_operation(code, e);
  --depth_;
  return value;
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
    case Op::Function: return evaluate_function(code, e);
    case Op::Negative:
      return evaluate_negative(evaluate(code, code.operands_of(e)[0]),
                               ast::Node(*code.tree, e.node).location(), sink_);
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
                                 evaluate(code, operands[1]),
                                 ast::Node(*code.tree, e.node).location(), sink_);
    }
    case Op::Interval: return evaluate_interval(code, e);
    case Op::List: return evaluate_list(code, e);
    case Op::Conditional: return evaluate_conditional(code, e);
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
    // Not two numbers, or something is wrong with them.
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

Value Evaluator::evaluate_triple(const Code& code, const Expression& e) {
  std::array<double, 3> components{};
  Unit unit = Unit::None;
  std::size_t count = 0, angles = 0;
  bool has_failed_component = false;
  std::uint32_t first_number = kNothing;
  for (const std::uint32_t operand : code.operands_of(e)) {
    Value value;
    const Scalar scalar = evaluate_number(code, operand, value);
    if (is_number(scalar)) {
      if (first_number == kNothing) first_number = operand;
      if (!are_compatible(unit, scalar.unit)) {
        sink_.report(diag::mixed_triple, place(code, operand), describe(Value(Scalar{0, unit})),
                     describe(Value(scalar)));
        has_failed_component = true;
      }
      if (scalar.unit != Unit::None) unit = scalar.unit;
      components[count] = scalar.value;
    } else if (const auto* angle = get_if<Angle>(&value)) {
      components[count] = angle->degrees;
      ++angles;
    } else {
      if (!is_nothing(value)) {
        sink_.report(diag::wrong_component, place(code, operand), describe(value));
      }
      has_failed_component = true;
    }
    ++count;
  }
  if (has_failed_component || count != components.size()) return Nothing{};

  const render::Vec3 value{components[0], components[1], components[2]};
  if (angles == 3) return AngleTriple{value};
  if (angles == 0) return Triple{value, unit};
  auto report = sink_.report(diag::mixed_triple, place(code, first_number), "an angle", "a number");
  if (node(code, first_number).is(SyntaxKind::Number)) {
    const std::uint32_t end = node(code, first_number).span().end;
    report.unsafe_fix(code.tree->location({end, end}), "deg");
  }
  return Nothing{};
}

Value Evaluator::evaluate_interval(const Code& code, const Expression& e) {
  const auto operands = code.operands_of(e);
  const Value from = evaluate(code, operands[0]), to = evaluate(code, operands[1]);
  if (is_nothing(from) || is_nothing(to)) return Nothing{};
  const auto* a = get_if<Scalar>(&from);
  const auto* b = get_if<Scalar>(&to);
  if (a != nullptr && b != nullptr && are_compatible(a->unit, b->unit)) {
    return Bounds{a->value, b->value, a->unit == Unit::None ? b->unit : a->unit};
  }
  sink_.report(diag::wrong_operands, ast::Node(*code.tree, e.node).location(), "..", describe(from),
               describe(to));
  return Nothing{};
}

// Lists and members

Value Evaluator::evaluate_list(const Code& code, const Expression& e) {
  const std::uint64_t bytes = std::uint64_t{e.count} * sizeof(Value);
  if (!take_steps(code, e.node, work::kList + e.count) || !may_take_memory(code, e.node, bytes))
    return Nothing{};
  std::vector<Value> values;
  values.reserve(e.count);
  bool is_broken = false;
  for (const std::uint32_t operand : code.operands_of(e)) {
    Value value = evaluate(code, operand);
    if (is_nothing(value)) {
      is_broken = true;
    } else if (values.empty() || are_of_one_type(values.front(), value)) {
      values.push_back(std::move(value));
    } else {
      sink_.report(diag::mixed_list, place(code, operand), describe(values.front()),
                   describe(value));
      is_broken = true;
    }
  }
  if (is_broken) return Nothing{};
  return ListValue(std::move(values));
}

Value Evaluator::evaluate_member(const Code& code, const Expression& e) {
  const Value value = evaluate(code, code.operands_of(e)[0]);
  if (is_nothing(value)) return Nothing{};
  const auto component = [&](render::Vec3 v) {
    return e.detail == 'x' ? v.x : e.detail == 'y' ? v.y : v.z;
  };
  const auto* triple = get_if<Triple>(&value);
  if (triple != nullptr && e.detail != 0) return Scalar{component(triple->value), triple->unit};
  const auto* angles = get_if<AngleTriple>(&value);
  if (angles != nullptr && e.detail != 0) return Angle{component(angles->degrees)};

  const ast::Node member(*code.tree, e.node);
  const std::string_view text = member.text();
  const std::string_view name = text.substr(text.rfind('.') + 1);
  auto report = sink_.report(diag::no_member, member.location(), describe(value),
                             name.substr(std::min(name.find_first_not_of(" \t\r\n"), name.size())));
  if (triple != nullptr || angles != nullptr) report.help("its members are `.x`, `.y` and `.z`");
  if (holds_alternative<ListValue>(value)) {
    report.help("`len(list)` is how many elements it has, and `list[0]` the first of them");
  }
  return Nothing{};
}

Value Evaluator::evaluate_index(const Code& code, const Expression& e) {
  const auto operands = code.operands_of(e);
  const Value value = evaluate(code, operands[0]), position = evaluate(code, operands[1]);
  if (is_nothing(value) || is_nothing(position)) return Nothing{};
  const auto* list = get_if<ListValue>(&value);
  if (list == nullptr) {
    auto report = sink_.report(diag::wrong_operand, ast::Node(*code.tree, e.node).location(), "[ ]",
                               describe(value));
    if (holds_alternative<Triple>(value)) report.help("its members are `.x`, `.y` and `.z`");
    return Nothing{};
  }
  const Location where = place(code, operands[1]);
  const auto* number = get_if<Scalar>(&position);
  if (number == nullptr || number->unit != Unit::None) {
    sink_.report(diag::wrong_argument, where, "[ ]", "a whole number", describe(position));
    return Nothing{};
  }
  if (number->value != std::floor(number->value)) {
    sink_.report(diag::not_whole, where, "[ ]", to_text(number->value))
        .help("round it with `floor(…)` or `round(…)`");
    return Nothing{};
  }
  if (number->value < 0 || number->value >= static_cast<double>(list->size())) {
    sink_.report(diag::index_out_of_range, where, to_text(number->value), list->size())
        .help("the first element has index 0");
    return Nothing{};
  }
  return (*list)[static_cast<std::size_t>(number->value)];
}

// Calls

Value Evaluator::evaluate_builtin(const Code& code, const Expression& e) {
  const auto operands = code.operands_of(e);
  const Builtin& builtin = all_builtins()[operands[0]];
  constexpr std::size_t kFew = 4;
  std::array<Value, kFew> few;
  std::vector<Value> many;
  const std::size_t count = operands.size() - 1;
  if (count > kFew) many.resize(count);
  const std::span<Value> arguments(count > kFew ? many.data() : few.data(), count);
  bool is_broken = false;
  for (std::size_t i = 0; i < count; ++i) {
    const Scalar number = evaluate_number(code, operands[i + 1], arguments[i]);
    if (is_number(number)) {
      arguments[i] = number;
      continue;
    }
    is_broken = is_broken || is_nothing(arguments[i]);
    const bool is_read = builtin.steps > 0;
    if (is_read && !take_steps(code, e.node, steps_to_read(arguments[i]))) return Nothing{};
  }
  if (is_broken || !take_steps(code, e.node, builtin.steps + count)) {
    return Nothing{};
  }
  if (builtin.more_steps != nullptr) steps_ += builtin.more_steps(arguments);
  return builtin.evaluate({.name = builtin.name,
                           .arguments = arguments,
                           .node = ast::Node(*code.tree, e.node),
                           .sink = sink_});
}

Value Evaluator::evaluate_constructor(const Code& code, const Expression& e) {
  const auto operands = code.operands_of(e);
  const Constructor& constructor = all_constructors()[operands[0]];
  ConstructorArguments arguments;
  bool is_broken = false;
  for (std::size_t i = 0; i < constructor.parameters.size(); ++i) {
    const Property& parameter = constructor.parameters[i];
    const std::uint32_t operand = operands[i + 1];
    if (operand == kNothing) {
      arguments[i] = default_of(parameter);
    } else {
      arguments[i] = property_value(code, parameter, operand);
      is_broken = is_broken || is_nothing(arguments[i]);
    }
  }
  if (is_broken) return Nothing{};
  steps_ += constructor.steps(arguments);
  return constructor.construct(constructor, arguments);
}

Value Evaluator::check_type(const Module& module, std::string_view name, const TypeInfo* type,
                            NodeIndex declaration, Value value, Location where) {
  if (type == nullptr || is_nothing(value) || type->holds(value)) return value;
  auto report = sink_.report(diag::declared_type, where, name, type->name, describe(value));
  const ast::Node statement(module.tree, declaration);
  if (const auto written = statement.first(SyntaxKind::TypeName)) {
    report.label(written->location(), "declared here");
  }
  return Nothing{};
}

Value Evaluator::evaluate_function(const Code& code, const Expression& e) {
  const auto operands = code.operands_of(e);
  const Module& module = program_.module(operands[0]);
  const Definition& function = module.functions[operands[1]];
  const auto arguments = operands.subspan(2);
  if (!take_steps(code, e.node, work::kCall + arguments.size())) return Nothing{};
  if (!may_call(code, e.node)) return Nothing{};

  const auto opened = open_frame(code, e.node, function.frame_size);
  if (!opened) return Nothing{};
  const std::size_t base = *opened;
  bool is_broken = function.body == kNothing;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    if (arguments[i] == kNothing) continue;
    const Parameter& parameter = function.parameters[i];
    Value value = check_type(module, parameter.name, parameter.type, parameter.node,
                             evaluate(code, arguments[i]), place(code, arguments[i]));
    is_broken = is_broken || is_nothing(value);
    locals_[base + i].values[0] = std::move(value);
  }
  Value result = Nothing{};
  if (!is_broken) {
    const Nested step(*this,
                      {.kind = Step::Call, .code = &code, .node = e.node, .name = function.name});
    const std::size_t frame = std::exchange(frame_, base);
    ++calls_;
    for (std::size_t i = 0; i < arguments.size(); ++i) {
      // A default may use the parameters before it.
      const Parameter& parameter = function.parameters[i];
      if (arguments[i] != kNothing) continue;
      locals_[base + i].values[0] =
          check_type(module, parameter.name, parameter.type, parameter.node,
                     evaluate(module.code, parameter.default_value),
                     place(module.code, parameter.default_value));
      is_broken = is_broken || is_nothing(locals_[base + i].values[0]);
    }
    if (!is_broken) result = evaluate(module.code, function.body);
    end_call();
    frame_ = frame;
  }
  locals_.resize(base);
  return result;
}

}  // namespace sdlc::lang
