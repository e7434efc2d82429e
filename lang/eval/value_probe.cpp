#include "lang/eval/value_probe.hpp"

#include <utility>
#include <vector>

#include "lang/eval/evaluator.hpp"
#include "lang/eval/used_values.hpp"
#include "lang/resolve/resolver.hpp"

namespace sdlc::lang {

/// An Evaluator with a closed shutter whose globals are evaluated on demand.
class SingleValues {
 public:
  SingleValues(Program& program, std::uint64_t max_steps, const StopRequest* stop)
      : program_(program),
        max_steps_(max_steps),
        ignored_(stop),
        evaluator_(program, {.steps = max_steps}, ignored_, Evaluator::OnDemand{}),
        is_done_(program.module_count()) {
    ignored_.set_muted(true);
    evaluator_.globals_.resize(program.module_count());
  }

  ProbedValue global(std::uint32_t module, std::uint32_t index);
  ProbedValue expression(std::uint32_t module, ast::Node node, const Property* property);
  double time();

 private:
  void restart();
  /// False if a limit is exceeded.
  bool evaluate(const UsedValues& used);
  void evaluate_module(std::uint32_t module, const UsedValues& used, std::vector<bool>& visited);
  void find_time();
  ProbedValue result_of(Evaluator::Varying value) const;

  Program& program_;
  std::uint64_t max_steps_;
  DiagnosticSink ignored_;
  Evaluator evaluator_;
  std::vector<std::vector<bool>> is_done_;  // by module and global
  bool has_time_ = false;
};

void SingleValues::restart() {
  evaluator_.steps_ = 0;
  evaluator_.next_poll_ = 0;
  evaluator_.max_steps_ = max_steps_;
  evaluator_.has_given_up_ = false;
}

ProbedValue SingleValues::result_of(Evaluator::Varying value) const {
  if (evaluator_.has_given_up_) return {.is_too_expensive = true};
  return {.value = std::move(value.values[0]), .reads_time = value.reads_time};
}

ProbedValue SingleValues::global(std::uint32_t module, std::uint32_t index) {
  UsedValues used(program_);
  if (!used.add_global(module, index)) return {.is_too_expensive = true};
  restart();
  if (!evaluate(used)) return {.is_too_expensive = true};
  return result_of(evaluator_.globals_[module][index]);
}

ProbedValue SingleValues::expression(std::uint32_t module, ast::Node node,
                                     const Property* property) {
  Code code(node.tree());
  const std::uint32_t index =
      Resolver(program_, module, ignored_).resolve_value(node, property, code);
  UsedValues used(program_);
  if (!used.add(code, index)) return {.is_too_expensive = true};
  restart();
  if (!evaluate(used)) return {.is_too_expensive = true};
  return result_of(evaluator_.evaluate_over_shutter(code, index));
}

double SingleValues::time() {
  restart();
  find_time();
  return evaluator_.times_[0];
}

bool SingleValues::evaluate(const UsedValues& used) {
  if (used.uses_time()) find_time();
  std::vector<bool> visited(program_.module_count());
  for (std::uint32_t module = 0; module < program_.module_count(); ++module) {
    evaluate_module(module, used, visited);
  }
  return !evaluator_.has_given_up_;
}

/// After the modules that it imports.
void SingleValues::evaluate_module(std::uint32_t module, const UsedValues& used,
                                   std::vector<bool>& visited) {
  if (visited[module]) return;
  visited[module] = true;
  const Module& file = program_.module(module);
  for (const auto& [name, import] : file.imports) {
    if (import.module != kNothing) evaluate_module(import.module, used, visited);
  }
  if (!used.uses_module(module)) return;
  std::vector<bool>& is_done = is_done_[module];
  is_done.resize(file.globals.size());
  evaluator_.globals_[module].resize(file.globals.size());
  for (const std::uint32_t index : file.order) {
    if (is_done[index] || !used.contains(module, index)) continue;
    if (!evaluator_.take_steps(file.code, file.globals[index].node, work::kStatement)) return;
    evaluator_.globals_[module][index] = evaluator_.evaluate_global(module, index);
    is_done[index] = !evaluator_.has_given_up_;
  }
}

/// The animation gives the time of the first frame. Its own values do not depend on the time.
void SingleValues::find_time() {
  if (std::exchange(has_time_, true)) return;
  evaluator_.find_settings();
  UsedValues used(program_);
  for (const Evaluator::Setting& setting : evaluator_.settings_) {
    if (setting.kind->id != ObjectKind::Animation) continue;
    const Code code = evaluator_.resolve(setting);
    const auto pairs = code.operands_of(code.statements.back());
    for (std::size_t i = 1; i < pairs.size(); i += 2) {
      if (!used.add(code, pairs[i])) return;
    }
  }
  evaluate(used);
  evaluator_.find_animation();
  const auto& animation = evaluator_.animation_;
  if (animation) evaluator_.times_.fill(animation->first / animation->fps);
}

ValueProbe::ValueProbe(Program& program, std::uint64_t max_steps, const StopRequest* stop)
    : values_(std::make_unique<SingleValues>(program, max_steps, stop)) {}

ValueProbe::~ValueProbe() = default;

ProbedValue ValueProbe::global(std::uint32_t module, std::uint32_t global) {
  return values_->global(module, global);
}

ProbedValue ValueProbe::expression(std::uint32_t module, ast::Node expression,
                                   const Property* property) {
  return values_->expression(module, expression, property);
}

double ValueProbe::time() { return values_->time(); }

}  // namespace sdlc::lang
