#include "lang/eval/value_probe.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "lang/eval/evaluator.hpp"
#include "lang/eval/used_values.hpp"
#include "lang/resolve/resolver.hpp"

namespace sdlc::lang {

namespace {

/// Ranks of globals in the order of evaluation: a file comes after those that it imports.
class EvaluationOrder {
 public:
  explicit EvaluationOrder(const Program& program)
      : program_(program), files_(program.module_count(), kNothing), ranks_(files_.size()) {
    for (std::uint32_t module = 0; module < files_.size(); ++module) add_file(module);
  }

  /// The second is kNothing for a global that depends on itself, and is never evaluated.
  std::pair<std::uint32_t, std::uint32_t> rank(UsedValues::Item item) {
    std::vector<std::uint32_t>& ranks = ranks_[item.module];
    if (ranks.empty()) {
      const Module& file = program_.module(item.module);
      ranks.assign(file.globals.size(), kNothing);
      for (std::uint32_t i = 0; i < file.order.size(); ++i) ranks[file.order[i]] = i;
    }
    return {files_[item.module], ranks[item.global]};
  }

 private:
  void add_file(std::uint32_t module) {
    if (files_[module] != kNothing) return;
    files_[module] = 0;  // imports may be cyclic, which is reported
    for (const auto& [name, import] : program_.module(module).imports) {
      if (import.module != kNothing) add_file(import.module);
    }
    files_[module] = next_++;
  }

  const Program& program_;
  std::vector<std::uint32_t> files_;               // ranks, by module
  std::vector<std::vector<std::uint32_t>> ranks_;  // by module and global; empty until needed
  std::uint32_t next_ = 0;
};

}  // namespace

/// An Evaluator with a closed shutter whose globals are evaluated on demand.
class SingleValues {
 public:
  SingleValues(Program& program, std::uint64_t max_steps, const StopRequest* stop)
      : program_(program),
        max_steps_(max_steps),
        ignored_(stop),
        evaluator_(program, {.steps = max_steps}, ignored_, Evaluator::OnDemand{}),
        order_(program),
        known_(program) {
    ignored_.set_muted(true);
    evaluator_.globals_.resize(program.module_count());
  }

  ProbedValue global(std::uint32_t module, std::uint32_t index);
  ProbedValue expression(std::uint32_t module, ast::Node node, const Property* property);
  double time();

 private:
  void restart();
  /// False if a limit is exceeded.
  bool evaluate(UsedValues& used);
  void find_time();
  ProbedValue result_of(Evaluator::Varying value) const;

  Program& program_;
  std::uint64_t max_steps_;
  DiagnosticSink ignored_;
  Evaluator evaluator_;
  EvaluationOrder order_;
  GlobalSet known_;  // already evaluated
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
  restart();
  UsedValues used(program_, known_);
  const bool is_good = used.add_global(module, index) && evaluate(used);
  return is_good ? result_of(evaluator_.globals_[module][index])
                 : ProbedValue{.is_too_expensive = true};
}

ProbedValue SingleValues::expression(std::uint32_t module, ast::Node node,
                                     const Property* property) {
  restart();
  Code code(node.tree());
  const std::uint32_t index =
      Resolver(program_, module, ignored_).resolve_value(node, property, code);
  UsedValues used(program_, known_);
  const bool is_good = used.add(code, index) && evaluate(used);
  const Evaluator::Frame frame(evaluator_, code, code.expressions[index].node, code.frame_size);
  return is_good && frame.is_open() ? result_of(evaluator_.evaluate_over_shutter(code, index))
                                    : ProbedValue{.is_too_expensive = true};
}

double SingleValues::time() {
  restart();
  find_time();
  return evaluator_.times_[0];
}

bool SingleValues::evaluate(UsedValues& used) {
  if (used.uses_time()) find_time();
  auto& globals = used.globals();
  // All are there before one is read: a file in a cycle of imports may be read too early.
  for (const auto [module, index] : globals) {
    auto& values = evaluator_.globals_[module];
    if (values.empty()) values.resize(program_.module(module).globals.size());
  }
  std::ranges::sort(globals, {}, [&](UsedValues::Item item) { return order_.rank(item); });
  for (const auto [module, index] : globals) {
    const Module& file = program_.module(module);
    auto& values = evaluator_.globals_[module];
    if (order_.rank({module, index}).second == kNothing) continue;
    if (!evaluator_.take_steps(file.code, file.globals[index].node, work::kStatement)) break;
    values[index] = evaluator_.evaluate_global(module, index);
    if (evaluator_.has_given_up_) break;
    known_.add(module, index);
  }
  return !evaluator_.has_given_up_;
}

/// The animation gives the time of the first frame. Its own values do not depend on the time.
void SingleValues::find_time() {
  if (std::exchange(has_time_, true)) return;
  evaluator_.find_settings();
  UsedValues used(program_, known_);
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
