#include <memory>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "lang/eval/evaluator.hpp"
#include "lang/value/literals.hpp"
#include "lang/value/logic.hpp"

// Values of the top level, the params that --set gives, and declared types.
namespace sdlc::lang {

void Evaluator::evaluate_all_globals(Globals which) {
  std::vector<bool>& done = globals_done_[static_cast<std::size_t>(which)];
  done.assign(program_.module_count(), false);
  for (std::uint32_t module = 0; module < program_.module_count(); ++module) {
    evaluate_globals(module, which);
  }
}

void Evaluator::evaluate_or_take_time_free_globals() {
  std::vector<bool>& done = globals_done_[static_cast<std::size_t>(Globals::TimeFree)];
  TimeFreeValues* const values = options_.time_free;
  if (values != nullptr && values->content_) {
    globals_ = values->content_->globals;
    done = values->content_->done;
    steps_ += values->content_->steps;
    // Files that were included since.
    for (std::uint32_t module = 0; module < program_.module_count(); ++module) {
      evaluate_globals(module, Globals::TimeFree);
    }
    return;
  }
  const std::size_t diagnostics = sink_.diagnostics().size();
  evaluate_all_globals(Globals::TimeFree);
  // A repeated error is in no list of diagnostics.
  const bool is_clean = !has_given_up_ && !sink_.is_muted() && !sink_.has_errors() &&
                        sink_.diagnostics().size() == diagnostics;
  if (values == nullptr || !is_clean) return;
  values->content_ = std::make_unique<TimeFreeValues::Content>(
      TimeFreeValues::Content{.globals = globals_, .done = done, .steps = steps_});
}

void Evaluator::evaluate_globals(std::uint32_t module, Globals which) {
  std::vector<bool>& done = globals_done_[static_cast<std::size_t>(which)];
  if (done.size() <= module) done.resize(module + 1, false);
  if (done[module]) return;
  done[module] = true;
  const Module& file = program_.module(module);
  for (const auto& [name, import] : file.imports) {
    if (import.module != kNothing) evaluate_globals(import.module, which);
  }
  if (globals_.size() <= module) globals_.resize(module + 1);
  if (globals_[module].empty()) {
    for (const Global& global : file.globals) {
      globals_[module].push_back({.values = {}, .reads_time = global.uses_time});
    }
  }
  for (const std::uint32_t index : file.order) {
    const Global& global = file.globals[index];
    if (global.uses_time != (which == Globals::TimeDependent)) continue;
    if (!take_steps(file.code, global.node, work::kStatement)) return;
    globals_[module][index] = evaluate_global(module, index);
  }
}

Evaluator::Varying Evaluator::evaluate_global(std::uint32_t module, std::uint32_t index) {
  const Module& file = program_.module(module);
  const Global& global = file.globals[index];
  if (global.value == kNothing) return {};
  const Frame frame(*this, file.code, global.node, global.frame_size);
  if (!frame.is_open()) return {};
  Varying value = evaluate_over_shutter(file.code, global.value);
  for (Value& moment : value.values) {
    moment = check_type(file.code, global.name, global.type, global.node, std::move(moment),
                        place(file.code, global.value));
  }
  const bool may_be_set = module == Program::kRoot && global.is_param;
  return may_be_set ? with_setting(index, std::move(value)) : value;
}

Evaluator::Varying Evaluator::with_setting(std::uint32_t index, Varying value) {
  const std::optional<ParamSetting> setting = program_.setting_of(index);
  if (!setting) return value;
  const Global& global = program_.module(Program::kRoot).globals[index];
  const Value& original = value.values[0];
  const bool is_text = holds_alternative<std::string>(original) ||
                       (global.type != nullptr && global.type->name == "string");
  const Location whole{setting->file,
                       {0, static_cast<std::uint32_t>(setting->file->text().size())}};
  if (is_text) {
    if (!check_string_size(setting->file->text().size(), program_.limits(), whole, sink_))
      return {};
    return {.values = {std::string(setting->file->text())}};
  }
  if (setting->file->text().find_first_not_of(" \t\r\n") == std::string_view::npos) {
    sink_.report(diag::no_value, whole, fmt::format("--set {}", global.name));
    return {};
  }
  std::uint32_t expression = kNothing;
  const Code& code = program_.resolve_setting(*setting, expression, sink_);
  const Frame frame(*this, code, 0, code.frame_size);
  if (!frame.is_open()) return {};
  reads_time_ = false;
  Value given = evaluate(code, expression);
  if (reads_time_) {
    sink_.report(diag::depends_on_time, whole, global.name);
    return {};
  }
  if (is_nothing(given) || is_nothing(original)) return {.values = {given}};
  const bool fits =
      global.type != nullptr ? global.type->holds(given) : are_of_one_type(original, given);
  if (fits) return {.values = {given}};
  const ast::Node statement(program_.module(Program::kRoot).tree, global.node);
  sink_.report(diag::set_type, whole, global.name, describe(original), describe(given))
      .label(statement.first(SyntaxKind::Name)->location(), "declared here");
  return {};
}

/// A literal default must have the parameter's type, even if no call uses it.
void Evaluator::check_defaults() {
  for (std::uint32_t i = 0; i < program_.module_count(); ++i) {
    const Module& file = program_.module(i);
    for (const std::vector<Definition>* list : {&file.functions, &file.defs}) {
      for (const Definition& definition : *list) {
        for (const Parameter& parameter : definition.parameters) {
          check_default(file.code, parameter);
        }
      }
    }
    check_defaults(file.code);
  }
}

void Evaluator::check_defaults(const Code& code) {
  for (const Definition& definition : code.definitions) {
    for (const Parameter& parameter : definition.parameters) check_default(code, parameter);
  }
}

void Evaluator::check_default(const Code& code, const Parameter& parameter) {
  const std::uint32_t expression = parameter.default_value;
  if (expression == kNothing) return;
  const Op op = code.expressions[expression].op;
  if (op != Op::Number && op != Op::Constant) return;
  check_type(code, parameter.name, parameter.type, parameter.node, evaluate(code, expression),
             place(code, expression));
}

Value Evaluator::check_type(const Code& code, std::string_view name, const TypeInfo* type,
                            NodeIndex declaration, Value value, Location where) {
  if (type == nullptr || is_nothing(value) || type->holds(value)) return value;
  auto report = sink_.report(diag::declared_type, where, name, type->name, describe(value));
  const ast::Node statement(*code.tree, declaration);
  if (const auto written = statement.first(SyntaxKind::TypeName)) {
    report.label(written->location(), "declared here");
  }
  return Nothing{};
}

}  // namespace sdlc::lang
