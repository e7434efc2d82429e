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

void Evaluator::run_instance(const Code& code, const Statement& statement) {
  const auto operands = code.operands_of(statement);
  const Module& module = program_.module(operands[0]);
  const Definition& def = module.defs[operands[1]];
  const auto properties = operands.subspan(3, 2 * operands[2]);
  if (!take_steps(code, statement.node, work::kInstance)) return;
  if (!may_call(code, statement.node)) return;

  const auto base = open_frame(code, statement.node, def.frame_size);
  if (!base) return;
  const DefInstance instance{.code = code,
                             .node = statement.node,
                             .key = {.module = operands[0], .index = operands[1]},
                             .module = module,
                             .def = def,
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
  const Parameter& parameter = instance.def.parameters[i];
  Varying value = evaluate_over_shutter(from, expression);
  for (Value& moment : value.values) {
    moment = check_type(instance.module, parameter.name, parameter.type, parameter.node,
                        std::move(moment), place(from, expression));
  }
  const bool is_good = !is_nothing(value.values[0]);
  locals_[instance.base + i] = std::move(value);
  return is_good;
}

void Evaluator::place_instance(const DefInstance& instance) {
  const auto identity = identify_contents(instance);
  InstanceMemo::Contents contents;
  if (identity) {
    constexpr std::uint64_t kLookupSteps = 70;
    steps_ += kLookupSteps + identity->size() / work::kBytes;
    contents = memo_.look_up(instance.key, *identity);
  }
  // Calls nested too deeply are evaluated again, which reports them.
  const bool is_known =
      contents.number != 0 && !contents.is_new && calls_ + contents.height <= kMaxCalls;
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
  const int height = run_contents(instance);
  objects_->leave();
  if (!contents.is_new) return;
  if (report_count() == reports) return memo_.set_height(instance.key, *identity, height);
  // Errors and warnings are reported for each instance.
  memo_.forget(instance.key, *identity);
  objects_->forget_contents(contents.number);
}

int Evaluator::run_contents(const DefInstance& instance) {
  const Nested entry(*this, {.kind = StackEntry::Instance,
                             .code = &instance.code,
                             .node = instance.node,
                             .name = instance.def.name});
  const std::size_t frame = std::exchange(frame_, instance.base);
  const int deepest_outside = std::exchange(deepest_calls_, ++calls_);
  const Code& code = instance.module.code;
  bool has_failed = false;
  // A default may use the parameters before it.
  for (std::size_t i = 0; i < instance.arguments.size(); ++i) {
    if (instance.arguments[i] != kNothing) continue;
    const std::uint32_t expression = instance.def.parameters[i].default_value;
    if (!bind_argument(instance, i, code, expression)) has_failed = true;
  }
  if (!has_failed) run_block(code, instance.def.block);
  end_call();
  frame_ = frame;
  const int height = deepest_calls_ - calls_;
  deepest_calls_ = std::max(deepest_calls_, deepest_outside);
  return height;
}

std::optional<std::string> Evaluator::identify_contents(const DefInstance& instance) const {
  if (!objects_->wants_contents() || !memo_.is_worthwhile(instance.key)) return std::nullopt;
  std::string identity;
  for (std::size_t i = 0; i < instance.arguments.size(); ++i) {
    const Varying& value = locals_[instance.base + i];
    if (instance.arguments[i] == kNothing) {
      identity += 'd';  // the default: a function of the others
      continue;
    }
    identity += value.varies ? 'v' : value.reads_time ? 'r' : 'c';
    for (std::size_t moment = 0; moment < (value.varies ? 2 : 1); ++moment) {
      if (!append_identity(value.values[moment], identity)) return std::nullopt;
    }
  }
  // An include cycle depends on the files that are open.
  for (const std::uint32_t file : open_includes_) identity += fmt::format("/{}", file);
  return identity;
}

}  // namespace sdlc::lang
