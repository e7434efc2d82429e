#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "lang/eval/evaluator.hpp"
#include "lang/json/json.hpp"
#include "lang/source/limits.hpp"

namespace sdlc::lang {
namespace {

/// The steps of looking an instance up.
constexpr std::uint64_t kLookupSteps = 70;

/// The whole numbers of the interval `a .. b` as a list: `range(a, b + 1)`.
std::string as_range(ast::Node interval, const Bounds& bounds) {
  const std::string_view from = interval.child(0)->text(), to = interval.child(1)->text();
  const bool is_literal = to == to_text(bounds.to);
  return fmt::format("range({}, {})", from,
                     is_literal ? to_text(bounds.to + 1) : fmt::format("{} + 1", to));
}

/// Whether it is a sphere that can be seen. Others take no memory, so that a loop of them would
/// never reach a limit if they allowed for steps.
bool is_visible_sphere(const Object& object) {
  if (object.kind->id != ObjectKind::Sphere) return false;
  const auto* radius = get_if<Scalar>(&object.slots[sphere_property::kRadius].value);
  return radius != nullptr && radius->value > 0;
}

/// Passes the spheres of a config on and counts the visible ones.
class CountingSink final : public ObjectSink {
 public:
  explicit CountingSink(ObjectSink& objects) : objects_(objects) {}
  void add(const Object& object) override {
    if (is_visible_sphere(object)) ++count_;
    objects_.add(object);
  }
  std::uint64_t count() const noexcept { return count_; }

 private:
  ObjectSink& objects_;
  std::uint64_t count_ = 0;
};

}  // namespace

void Evaluator::run(const Code& code, std::uint32_t index) {
  const Statement& statement = code.statements[index];
  if (!take_steps(code, statement.node, work::kStatement)) return;
  if (!may_nest(code, statement.node)) return;
  ++depth_;
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
    case Action::Instance: run_instance(code, statement); break;
    case Action::Include: run_include(code, statement); break;
  }
  --depth_;
}

void Evaluator::run_block(const Code& code, std::span<const std::uint32_t> statements) {
  for (const std::uint32_t statement : statements) run(code, statement);
}

void Evaluator::run_for(const Code& code, const Statement& statement) {
  const auto operands = code.operands_of(statement);
  const std::uint32_t slot = operands[0], expression = operands[1];
  const Varying lists = evaluate_over_shutter(code, expression);
  if (is_nothing(lists.values[0])) return;
  const auto* list = get_if<ListValue>(&lists.values[0]);
  if (list == nullptr) {
    const Location where = place(code, expression);
    auto report = sink_.report(diag::not_a_list, where, describe(lists.values[0]));
    if (const auto* bounds = get_if<Bounds>(&lists.values[0])) {
      report.help("`a .. b` is not a list; `range(a, b)` is, and excludes b");
      const ast::Node written = node(code, expression);
      if (written.is(SyntaxKind::Interval)) report.unsafe_fix(where, as_range(written, *bounds));
    }
    if (holds_alternative<Scalar>(lists.values[0])) {
      report.help("`range(n)` is the list of the n numbers from 0 on");
    }
    return;
  }
  // Each element may depend on the time, but not their number.
  const auto* closing = lists.varies ? get_if<ListValue>(&lists.values[1]) : nullptr;
  if (closing != nullptr && closing->size() != list->size()) {
    sink_.report(diag::changes_in_shutter, place(code, expression), "for");
    closing = nullptr;
  }

  const ast::Node node(*code.tree, statement.node);
  const auto name = node.first(SyntaxKind::Name);
  const Nested step(*this, {.kind = Step::Turn,
                            .code = &code,
                            .node = statement.node,
                            .name = name ? name->text() : std::string_view(),
                            .local = frame_ + slot});
  const std::size_t step_index = steps_inside_.size() - 1;
  // A mistake in one turn is most likely in all of them: stop after the first.
  const std::size_t errors = sink_.error_count();
  for (std::size_t i = 0; i < list->size() && sink_.error_count() == errors; ++i) {
    steps_inside_[step_index].turn = i;
    Varying& variable = locals_[frame_ + slot];
    variable.values[0] = (*list)[i];
    variable.reads_time = lists.reads_time;
    variable.varies = closing != nullptr;
    if (closing != nullptr) variable.values[1] = (*closing)[i];
    if (!take_steps(code, code.expressions[expression].node, work::kTurn)) return;
    run_block(code, operands.subspan(3, operands[2]));
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
  // The lets run here for the properties, and again in their places: a loop before them may have
  // used their slots by then.
  run_block(code, operands.subspan(1, operands[0]));
  operands = operands.subspan(1 + operands[0]);
  steps_ += work::kGroup;
  read_object(code, statement, kind_info(ObjectKind::Group), operands.subspan(1, 2 * operands[0]));
  operands = operands.subspan(1 + 2 * operands[0]);
  const ast::Object written{ast::Node(*code.tree, statement.node)};
  const auto name = written.name();
  const Nested step(*this, {.kind = Step::Group,
                            .code = &code,
                            .node = statement.node,
                            .name = name ? name->text() : std::string_view()});
  take_rotation();
  objects_->enter(object_);
  run_block(code, operands.subspan(1));
  objects_->leave();
}

void Evaluator::take_rotation() {
  if (object_.slots[group_property::kRotate].is_written) steps_ += work::kRotation;
}

void Evaluator::run_instance(const Code& code, const Statement& statement) {
  const auto operands = code.operands_of(statement);
  const Module& module = program_.module(operands[0]);
  const Definition& def = module.defs[operands[1]];
  const auto pairs = operands.subspan(3, 2 * operands[2]);
  const auto arguments = operands.subspan(3 + pairs.size());
  if (!take_steps(code, statement.node, work::kInstance)) return;
  if (!may_call(code, statement.node)) return;

  const auto opened = open_frame(code, statement.node, def.frame_size);
  if (!opened) return;
  const std::size_t base = *opened;
  bool is_broken = false;
  const auto take = [&](std::size_t i, const Code& from, std::uint32_t expression) {
    const Parameter& parameter = def.parameters[i];
    Varying value = evaluate_over_shutter(from, expression);
    for (Value& moment : value.values) {
      moment = check_type(module, parameter.name, parameter.type, parameter.node, std::move(moment),
                          place(from, expression));
    }
    is_broken = is_broken || is_nothing(value.values[0]);
    locals_[base + i] = std::move(value);
  };
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    if (arguments[i] != kNothing) take(i, code, arguments[i]);
  }
  read_object(code, statement, kind_info(ObjectKind::Group), pairs);
  take_rotation();
  const InstanceMemo::Def key{.module = operands[0], .index = operands[1]};
  const auto identity = is_broken ? std::nullopt : identify_contents(key, base, arguments);
  InstanceMemo::Contents contents;
  if (identity) {
    steps_ += kLookupSteps + identity->size() / work::kBytes;
    contents = memo_.look_up(key, *identity);
  }
  // Nesting beyond the limit is evaluated again, which reports it.
  const bool is_known =
      contents.number != 0 && !contents.is_new && calls_ + contents.height <= kMaxCalls;
  const std::uint64_t bytes = CountedBytes::sum();
  if (is_known && objects_->repeat(object_, contents.number)) {
    deepest_calls_ = std::max(deepest_calls_, calls_ + contents.height);
    // Empty or duplicate contents take no memory: a loop of them would never reach a limit.
    if (CountedBytes::sum() > bytes) allow_steps(1);
  } else if (!is_broken) {
    const std::size_t reports = report_count();
    const Nested step(
        *this, {.kind = Step::Instance, .code = &code, .node = statement.node, .name = def.name});
    objects_->enter(object_);
    if (contents.is_new) objects_->begin_contents(contents.number);
    const std::size_t frame = std::exchange(frame_, base);
    const int deepest_outside = std::exchange(deepest_calls_, ++calls_);
    // A default may use the parameters before it.
    for (std::size_t i = 0; i < arguments.size(); ++i) {
      if (arguments[i] == kNothing) take(i, module.code, def.parameters[i].default_value);
    }
    if (!is_broken) run_block(module.code, def.block);
    end_call();
    frame_ = frame;
    objects_->leave();
    if (contents.is_new && report_count() != reports) {
      // Errors and warnings are reported for each instance.
      memo_.forget(key, *identity);
      objects_->forget_contents(contents.number);
    } else if (contents.is_new) {
      memo_.set_height(key, *identity, deepest_calls_ - calls_);
    }
    deepest_calls_ = std::max(deepest_calls_, deepest_outside);
  }
  locals_.resize(base);
}

std::optional<std::string> Evaluator::identify_contents(
    InstanceMemo::Def def, std::size_t base, std::span<const std::uint32_t> arguments) const {
  if (!objects_->wants_contents() || !memo_.is_worthwhile(def)) return std::nullopt;
  std::string identity;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const Varying& value = locals_[base + i];
    if (arguments[i] == kNothing) {
      identity += 'd';  // a default, which depends on the others only
      continue;
    }
    identity += value.varies ? 'v' : value.reads_time ? 'r' : 'c';
    for (std::size_t moment = 0; moment < (value.varies ? 2 : 1); ++moment) {
      if (!append_identity(value.values[moment], identity)) return std::nullopt;
    }
  }
  // The files being run decide whether an include is circular.
  for (const std::uint32_t file : files_inside_) identity += fmt::format("/{}", file);
  return identity;
}

bool Evaluator::is_in_circle(const Code& code, const Statement& statement, std::uint32_t file) {
  // Most circles are found when the files are read, but not one through a file that an import has
  // read before.
  const auto first = std::find(files_inside_.begin(), files_inside_.end(), file);
  if (first == files_inside_.end()) return false;
  std::vector<std::string> circle;
  for (auto inside = first; inside != files_inside_.end(); ++inside) {
    circle.push_back(fmt::format("`{}`", program_.module(*inside).file->name()));
  }
  circle.push_back(circle.front());
  const auto name = ast::Node(*code.tree, statement.node).first(SyntaxKind::String);
  sink_.report(diag::file_circle, name->location(), program_.module(file).file->name())
      .help(fmt::format("the circle is {}", fmt::join(circle, " → ")));
  return true;
}

void Evaluator::run_include(const Code& code, const Statement& statement) {
  const std::uint32_t included = code.operands_of(statement)[0];
  const SourceFile& file =
      included >= kConfigs ? program_.config(included) : *program_.module(included).file;
  const bool is_new = included_.insert(included).second;
  const std::uint64_t bytes = is_new ? 0 : file.text().size();
  if (!take_steps(code, statement.node, work::kInclude + bytes * work::kIncludedByte)) return;
  const Nested step(*this,
                    {.kind = Step::Include, .code = &code, .node = statement.node, .name = {}});
  if (included >= kConfigs) {
    CountingSink counted(*objects_);
    read_spheres(file, counted, sink_);
    allow_steps(counted.count());
    return;
  }
  if (is_in_circle(code, statement, included)) return;
  evaluate_globals(included, Globals::TimeFree);
  evaluate_globals(included, Globals::TimeDependent);
  const std::size_t frame = std::exchange(frame_, locals_.size());
  files_inside_.push_back(included);
  run_file(included);
  files_inside_.pop_back();
  frame_ = frame;
}

}  // namespace sdlc::lang
