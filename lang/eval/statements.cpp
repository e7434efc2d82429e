#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "lang/eval/evaluator.hpp"
#include "lang/eval/type_hints.hpp"
#include "lang/source/limits.hpp"
#include "lang/value/logic.hpp"

namespace sdlc::lang {

void Evaluator::run(const Code& code, std::uint32_t index) {
  const Statement& statement = code.statements[index];
  if (!take_steps(code, statement.node, work::kStatement)) return;
  if (StackSegments::is_low()) [[unlikely]] {
    return run_on_segment(code, statement.node, [&] { run_action(code, statement); });
  }
  run_action(code, statement);
}

void Evaluator::run_action(const Code& code, const Statement& statement) {
  switch (statement.action) {
    case Action::Let: {
      const auto operands = code.operands_of(statement);
      Varying value = evaluate_over_shutter(code, operands[1]);
      locals_[frame_ + operands[0]] = std::move(value);
      break;
    }
    case Action::For: run_for(code, statement); break;
    case Action::If: run_if(code, statement); break;
    case Action::Assert: run_assert(code, statement); break;
    case Action::Object: run_object(code, statement); break;
    case Action::Group: run_group(code, statement); break;
    case Action::Instance:
    case Action::LocalInstance: run_instance(code, statement); break;
    case Action::Include:
      if (StackSegments::has_less_than(StackSegments::kFile)) {
        return run_on_segment(
            code, statement.node, [&] { run_include(code, statement); }, StackSegments::kFile);
      }
      run_include(code, statement);
      break;
  }
}

void Evaluator::run_block(const Code& code, std::span<const std::uint32_t> statements) {
  for (const std::uint32_t statement : statements) run(code, statement);
}

void Evaluator::report_not_a_list(const Code& code, std::uint32_t expression, const Value& value) {
  const Location where = place(code, expression);
  if (const auto* row = get_if<RowValue>(&value)) return report_mixed(*row, where, sink_);
  auto report = sink_.report(diag::not_a_list, where, describe(value));
  if (const auto* bounds = get_if<Bounds>(&value)) {
    report.help(
        "`a .. b` is an interval; `range(a, b)` is the list of the numbers from a to b - 1");
    const ast::Node written = node(code, expression);
    if (written.is(SyntaxKind::Interval)) report.unsafe_fix(where, as_range(written, *bounds));
  }
  const auto* number = get_if<Scalar>(&value);
  if (number == nullptr || number->unit != Unit::None) return;
  report.help("`range(n)` is the list of the numbers from 0 to n - 1");
  const bool is_count = number->value >= 0 && std::floor(number->value) == number->value;
  if (is_count) report.unsafe_fix(where, fmt::format("range({})", node(code, expression).text()));
}

void Evaluator::run_for(const Code& code, const Statement& statement) {
  const auto operands = code.operands_of(statement);
  const std::uint32_t expression = operands[LoopSlots::kOperands];
  const Varying lists = evaluate_over_shutter(code, expression);
  if (is_nothing(lists.values[0])) return;
  const auto* list = get_if<ListValue>(&lists.values[0]);
  if (list == nullptr) return report_not_a_list(code, expression, lists.values[0]);
  // The elements may depend on the time, their number may not.
  const auto* closing = lists.varies ? get_if<ListValue>(&lists.values[1]) : nullptr;
  if (closing != nullptr && closing->size() != list->size()) {
    sink_.report(diag::changes_in_shutter, place(code, expression), "for");
    closing = nullptr;
  }

  const Loop loop{.code = code,
                  .node = statement.node,
                  .names = LoopSlots(operands),
                  .list = expression,
                  .opening = *list,
                  .closing = closing,
                  .reads_time = lists.reads_time};
  const auto block = operands.subspan(LoopSlots::kOperands + 1);
  const Nested entry(*this, {.kind = StackEntry::Iteration,
                             .code = &code,
                             .node = statement.node,
                             .local = frame_ + loop.names.slot});
  const std::size_t entry_index = stack_.size() - 1;
  // An error in one iteration is most likely in all of them: stop after the first.
  const std::size_t errors = sink_.error_count();
  for (std::size_t i = 0; i < list->size() && sink_.error_count() == errors; ++i) {
    stack_[entry_index].iteration = i;
    if (!bind_names(loop, i)) return;
    const std::uint64_t steps = work::kTurn + loop.names.part_count;
    if (!take_steps(code, code.expressions[expression].node, steps)) return;
    run_block(code, block.subspan(1, block[0]));
  }
}

void Evaluator::run_if(const Code& code, const Statement& statement) {
  const auto operands = code.operands_of(statement);
  for (std::size_t i = 0; i + 1 < operands.size(); i += 2 + operands[i + 1]) {
    const std::uint32_t condition = operands[i];
    bool holds = true;
    if (condition != kNothing) {
      reads_time_ = false;
      const auto value = evaluate_condition(code, condition, "if");
      if (!value) return;
      holds = *value;
      if (reads_time_ && is_open_) {
        moment_ = 1;
        const auto closing = evaluate_condition(code, condition, "if");
        moment_ = 0;
        if (closing && *closing != holds) {
          sink_.report(diag::changes_in_shutter, place(code, condition), "if");
        }
      }
    }
    if (holds) return run_block(code, operands.subspan(i + 2, operands[i + 1]));
  }
}

void Evaluator::run_assert(const Code& code, const Statement& statement) {
  const auto operands = code.operands_of(statement);
  const auto holds = evaluate_condition(code, operands[0], "assert");
  if (!holds || *holds) return;
  const Value text = evaluate(code, operands[1]);
  if (const auto* words = get_if<std::string>(&text)) {
    if (!take_steps(code, statement.node, words->size())) return;
    sink_.report(diag::failed_assertion, place(code, operands[0]), *words);
  } else if (!is_nothing(text)) {
    sink_.report(diag::wrong_argument, place(code, operands[1]), "assert", "a string",
                 describe(text));
  }
}

bool Evaluator::is_visible_sphere(const Object& object) {
  if (object.kind->id != ObjectKind::Sphere) return false;
  const auto* radius = get_if<Scalar>(&object.slots[sphere_property::kRadius].value);
  return radius != nullptr && radius->value > 0;
}

void Evaluator::run_object(const Code& code, const Statement& statement) {
  center_reads_time_ = false;
  read_object(code, statement, kind_info(statement.kind), code.operands_of(statement));
  const Slot& motion = object_.slots[sphere_property::kMotion];
  if (statement.kind == ObjectKind::Sphere && center_reads_time_ && motion.is_written) {
    sink_.report(diag::two_motions, object_.location(sphere_property::kMotion));
  }
  objects_->add(object_);
  if (is_visible_sphere(object_)) allow_steps(1);
}

void Evaluator::run_group(const Code& code, const Statement& statement) {
  auto operands = code.operands_of(statement);
  // The properties use the lets, so these run first. They run again in their places, because a loop
  // before them may share their slots.
  run_block(code, operands.subspan(1, operands[0]));
  operands = operands.subspan(1 + operands[0]);
  steps_ += work::kGroup;
  read_object(code, statement, kind_info(ObjectKind::Group), operands.subspan(1, 2 * operands[0]));
  operands = operands.subspan(1 + 2 * operands[0]);
  const ast::Object written{ast::Node(*code.tree, statement.node)};
  const auto name = written.name();
  const Nested entry(*this, {.kind = StackEntry::Group,
                             .code = &code,
                             .node = statement.node,
                             .name = name ? name->text() : std::string_view()});
  take_rotation();
  objects_->enter(object_);
  run_block(code, operands.subspan(1));
  objects_->leave();
}

}  // namespace sdlc::lang
