#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "lang/eval/evaluator.hpp"
#include "lang/source/limits.hpp"
#include "lang/value/builtins.hpp"

// Calls of built-in functions, constructors and functions.
namespace sdlc::lang {

Value Evaluator::evaluate_builtin(const Code& code, const Expression& e) {
  const auto operands = code.operands_of(e);
  const Builtin& builtin = all_builtins()[operands[0]];
  constexpr std::size_t kMaxOnStack = 4;
  std::array<Value, kMaxOnStack> on_stack;
  std::vector<Value> on_heap;
  const std::size_t count = operands.size() - 1 - builtin.options.size();
  if (count > kMaxOnStack) on_heap.resize(count);
  const std::span<Value> arguments(count > kMaxOnStack ? on_heap.data() : on_stack.data(), count);
  bool has_failed = false;
  for (std::size_t i = 0; i < count; ++i) {
    const Scalar number = evaluate_number(code, operands[i + 1], arguments[i]);
    if (is_number(number)) {
      arguments[i] = number;
      continue;
    }
    has_failed = has_failed || is_nothing(arguments[i]);
    const bool is_read = builtin.steps > 0;
    if (is_read && !take_steps(code, e.node, steps_to_read(arguments[i]))) return Nothing{};
  }
  if (has_failed || !take_steps(code, e.node, builtin.steps + count)) return Nothing{};
  BuiltinCall call{.function = builtin,
                   .arguments = arguments,
                   .options = {},
                   .node = ast::Node(*code.tree, e.node),
                   .sink = sink_};
  if (builtin.options.empty()) {
    return builtin.more_work == nullptr ? builtin.evaluate(call) : run_builtin(code, call);
  }
  std::array<Value, kMaxOptions> options;
  if (!read_options(code, builtin, operands.subspan(1 + count), options)) return Nothing{};
  call.options = std::span(options).first(builtin.options.size());
  return run_builtin(code, call);
}

bool Evaluator::read_options(const Code& code, const Builtin& builtin,
                             std::span<const std::uint32_t> operands, std::span<Value> options) {
  bool is_good = true;
  for (std::size_t i = 0; i < operands.size(); ++i) {
    const Property& option = builtin.options[i];
    if (operands[i] == kNothing) {
      options[i] = default_of(option);
    } else {
      options[i] = property_value(code, option, operands[i]);
      is_good = is_good && !is_nothing(options[i]);
    }
  }
  return is_good;
}

Value Evaluator::run_builtin(const Code& code, const BuiltinCall& call) {
  const auto more_work = call.function.more_work;
  if (more_work != nullptr) {
    const BuiltinWork work = more_work(call);
    const NodeIndex node = call.node.index();
    if (!take_steps(code, node, work.steps) || !may_take_memory(code, node, work.bytes)) {
      return Nothing{};
    }
  }
  return call.function.evaluate(call);
}

Value Evaluator::evaluate_constructor(const Code& code, const Expression& e) {
  const auto operands = code.operands_of(e);
  const Constructor& constructor = all_constructors()[operands[0]];
  ConstructorArguments arguments;
  bool has_failed = false;
  for (std::size_t i = 0; i < constructor.parameters.size(); ++i) {
    const Property& parameter = constructor.parameters[i];
    const std::uint32_t operand = operands[i + 1];
    if (operand == kNothing) {
      arguments[i] = default_of(parameter);
    } else {
      arguments[i] = property_value(code, parameter, operand);
      has_failed = has_failed || is_nothing(arguments[i]);
    }
  }
  if (has_failed) return Nothing{};
  steps_ += constructor.steps(arguments);
  return constructor.construct(constructor, arguments);
}

const Evaluator::Environment* Evaluator::environment_of(const Environment& here,
                                                        std::uint32_t outwards) {
  const Environment* environment = &here;
  for (; outwards > 0; --outwards) environment = environment->outer;
  return environment;
}

Evaluator::Callee Evaluator::callee_of(const Code& code, const Expression& e,
                                       const Environment& here) const {
  const auto operands = code.operands_of(e);
  if (e.op == Op::LocalFunction) {
    return {code, code.definitions[operands[1]], environment_of(here, operands[0])};
  }
  const Module& module = program_.module(operands[0]);
  return {module.code, module.functions[operands[1]], nullptr};
}

Value Evaluator::evaluate_function(const Code& code, const Expression& e) {
  const Environment here{frame_, environment_};
  const auto [body, function, environment] = callee_of(code, e, here);
  const auto arguments = code.operands_of(e).subspan(2);
  if (!take_steps(code, e.node, work::kCall + arguments.size())) return Nothing{};
  if (!may_call(code, e.node)) return Nothing{};

  const auto opened = open_frame(code, e.node, function.frame_size);
  if (!opened) return Nothing{};
  const std::size_t base = *opened;
  bool has_failed = function.body == kNothing;
  const auto bind = [&, &body = body, &function = function](std::size_t i, const Code& from,
                                                            std::uint32_t expression) {
    const Parameter& parameter = function.parameters[i];
    Value value = check_type(body, parameter.name, parameter.type, parameter.node,
                             evaluate(from, expression), place(from, expression));
    has_failed = has_failed || is_nothing(value);
    locals_[base + i].values[0] = std::move(value);
  };
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    if (arguments[i] != kNothing) bind(i, code, arguments[i]);
  }
  Value result = Nothing{};
  if (!has_failed) {
    const Nested entry(
        *this, {.kind = StackEntry::Call, .code = &code, .node = e.node, .name = function.name});
    frame_ = base;
    environment_ = environment;
    deepest_calls_ = std::max(deepest_calls_, ++calls_);
    // A default may use the parameters before it.
    for (std::size_t i = 0; i < arguments.size(); ++i) {
      if (arguments[i] == kNothing) bind(i, body, function.parameters[i].default_value);
    }
    if (!has_failed) result = evaluate(body, function.body);
    end_call();
    frame_ = here.frame;
    environment_ = here.outer;
  }
  locals_.resize(base);
  return result;
}

}  // namespace sdlc::lang
