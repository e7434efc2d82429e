#include <algorithm>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "lang/eval/evaluator.hpp"
#include "lang/source/limits.hpp"

// Instances of defs. Equal contents are evaluated once and repeated: see InstanceMemo.
namespace sdlc::lang {

void Evaluator::take_rotation() {
  if (object_.slots[group_property::kRotate].is_written) steps_ += work::kRotation;
}

Evaluator::Callee Evaluator::callee_of(const Code& code, const Statement& statement,
                                       const Environment& here) const {
  const auto operands = code.operands_of(statement);
  if (statement.action == Action::LocalInstance) {
    return {code, code.definitions[operands[1]], environment_of(here, operands[0])};
  }
  const Module& module = program_.module(operands[0]);
  return {module.code, module.defs[operands[1]], nullptr};
}

void Evaluator::run_instance(const Code& code, const Statement& statement) {
  const auto operands = code.operands_of(statement);
  const Environment here{frame_, environment_};
  const Callee callee = callee_of(code, statement, here);
  const auto properties = operands.subspan(3, 2 * operands[2]);
  if (!take_steps(code, statement.node, work::kInstance)) return;
  if (!may_call(code, statement.node)) return;

  const auto base = open_frame(code, statement.node, callee.definition.frame_size);
  if (!base) return;
  const DefInstance instance{.code = code,
                             .node = statement.node,
                             .callee = callee,
                             .arguments = operands.subspan(3 + properties.size()),
                             .base = *base};
  bool has_failed = false;
  for (std::size_t i = 0; i < instance.arguments.size(); ++i) {
    const std::uint32_t argument = instance.arguments[i];
    if (argument != kNothing && !bind_argument(instance, i, code, argument)) has_failed = true;
  }
  read_object(code, statement, kind_info(ObjectKind::Group), properties);
  take_rotation();
  if (!has_failed) place_instance(instance);
  locals_.resize(*base);
}

bool Evaluator::bind_argument(const DefInstance& instance, std::size_t i, const Code& from,
                              std::uint32_t expression) {
  const Parameter& parameter = instance.callee.definition.parameters[i];
  Varying value = evaluate_over_shutter(from, expression);
  for (Value& moment : value.values) {
    moment = check_type(instance.callee.code, parameter.name, parameter.type, parameter.node,
                        std::move(moment), place(from, expression));
  }
  const bool is_good = !is_nothing(value.values[0]);
  locals_[instance.base + i] = std::move(value);
  return is_good;
}

void Evaluator::place_instance(const DefInstance& instance) {
  const Definition& def = instance.callee.definition;
  const InstanceMemo::Def key{.module = def.module, .node = def.node};
  const auto identity = identify_contents(instance);
  InstanceMemo::Contents contents;
  if (identity) {
    constexpr std::uint64_t kLookupSteps = 70;
    steps_ += kLookupSteps + identity->size() / work::kBytes;
    contents = memo_.look_up(key, *identity);
  }
  // Calls nested too deeply are evaluated again, which reports them.
  const bool is_known = contents.number != 0 && !contents.is_new &&
                        calls_ + contents.height <= program_.limits().calls;
  const std::uint64_t bytes = CountedBytes::sum();
  if (is_known && objects_->repeat(object_, contents.number)) {
    deepest_calls_ = std::max(deepest_calls_, calls_ + contents.height);
    // Empty or duplicate contents take no memory: a loop of them would never reach a limit.
    if (CountedBytes::sum() > bytes) allow_steps(1);
    return;
  }
  const std::size_t reports = report_count();
  objects_->enter(object_);
  if (contents.is_new) objects_->begin_contents(contents.number);
  const std::uint64_t height = run_contents(instance);
  objects_->leave();
  if (!contents.is_new) return;
  if (report_count() == reports) return memo_.set_height(key, *identity, height);
  // Errors and warnings are reported for each instance.
  memo_.forget(key, *identity);
  objects_->forget_contents(contents.number);
}

std::uint64_t Evaluator::run_contents(const DefInstance& instance) {
  const Nested entry(*this, {.kind = StackEntry::Instance,
                             .code = &instance.code,
                             .node = instance.node,
                             .name = instance.callee.definition.name});
  const std::size_t frame = std::exchange(frame_, instance.base);
  const Environment* environment = std::exchange(environment_, instance.callee.environment);
  const std::uint64_t deepest_outside = std::exchange(deepest_calls_, ++calls_);
  const Code& code = instance.callee.code;
  bool has_failed = false;
  // A default may use the parameters before it.
  for (std::size_t i = 0; i < instance.arguments.size(); ++i) {
    if (instance.arguments[i] != kNothing) continue;
    const std::uint32_t expression = instance.callee.definition.parameters[i].default_value;
    if (!bind_argument(instance, i, code, expression)) has_failed = true;
  }
  if (!has_failed) run_block(code, instance.callee.definition.block);
  end_call();
  frame_ = frame;
  environment_ = environment;
  const std::uint64_t height = deepest_calls_ - calls_;
  deepest_calls_ = std::max(deepest_calls_, deepest_outside);
  return height;
}

std::optional<std::string> Evaluator::identify_contents(const DefInstance& instance) const {
  const Definition& def = instance.callee.definition;
  const InstanceMemo::Def key{.module = def.module, .node = def.node};
  const bool is_known = !def.reads_more_outer && memo_.is_worthwhile(key);
  if (!objects_->wants_contents() || !is_known) return std::nullopt;
  std::string identity;
  const auto append = [&](const Varying& value) {
    identity += value.varies ? 'v' : value.reads_time ? 'r' : 'c';
    bool is_good = append_identity(value.values[0], identity);
    if (value.varies) is_good = is_good && append_identity(value.values[1], identity);
    return is_good;
  };
  for (std::size_t i = 0; i < instance.arguments.size(); ++i) {
    if (instance.arguments[i] == kNothing) {
      identity += 'd';  // the default: a function of the others
    } else if (!append(locals_[instance.base + i])) {
      return std::nullopt;
    }
  }
  for (const OuterLocal& local : def.outer) {
    const std::uint32_t outwards = def.frame - local.frame;
    if (!append(outer_local(instance.callee.environment, outwards, local.slot))) {
      return std::nullopt;
    }
  }
  // An include cycle depends on the files that are open.
  for (const std::uint32_t file : open_includes_) identity += fmt::format("/{}", file);
  return identity;
}

}  // namespace sdlc::lang
