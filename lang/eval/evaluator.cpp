#include "lang/eval/evaluator.hpp"

#include <algorithm>
#include <string>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "lang/resolve/resolver.hpp"
#include "lang/schema/find_kind.hpp"
#include "lang/value/literals.hpp"
#include "lang/value/logic.hpp"

// The phases of an evaluation. `time` follows from the animation, and the shutter's times from the
// chosen camera; what they are made of must be known before anything else is evaluated.
namespace sdlc::lang {
namespace {

constexpr std::uint64_t kMaxSteps = std::uint64_t{1} << 62;

/// The expression that code of one object gives a property; kNothing where it is not written.
std::uint32_t expression_of(const Code& code, const Statement& statement, std::size_t property) {
  const auto pairs = code.operands_of(statement);
  for (std::size_t i = 0; i + 1 < pairs.size(); i += 2) {
    if (pairs[i] == property) return pairs[i + 1];
  }
  return kNothing;
}

/// Whether it is an object of a kind that only the root's own top level is asked for.
bool is_setting(const Module& file, ast::Node statement) {
  if (!statement.is(SyntaxKind::Object)) return false;
  const std::string_view name = ast::Object{statement}.kind();
  const Kind* kind = find_kind(name);
  return !file.def_names.contains(name) && kind != nullptr && kind->is_setting;
}

bool is_declaration(SyntaxKind kind) noexcept {
  return kind == SyntaxKind::Let || kind == SyntaxKind::Param || kind == SyntaxKind::Fn ||
         kind == SyntaxKind::Def || kind == SyntaxKind::Import || kind == SyntaxKind::Version ||
         kind == SyntaxKind::Error;
}

}  // namespace

Evaluator::Evaluator(Program& program, const EvaluationOptions& options, DiagnosticSink& sink)
    : program_(program),
      options_(options),
      sink_(sink),
      max_steps_(std::min(options.steps.value_or(program.limits().steps), kMaxSteps)) {
  sink_.set_chain(this);
  find_settings();
  evaluate_all_globals(Globals::TimeFree);
  find_animation();
  if (animation_) {
    const double time = options_.frame.value_or(animation_->first) / animation_->fps;
    times_ = {time, time};
  }
  // The shutter is evaluated at the frame's own time. Other values may have none at that time, so
  // the sink is muted.
  sink_.set_muted(true);
  const auto before = std::tuple(steps_, max_steps_, has_given_up_);
  evaluate_all_globals(Globals::TimeDependent);
  std::tie(steps_, max_steps_, has_given_up_) = before;  // a limit is reported in the second run
  sink_.set_muted(false);
  find_shutter();
  evaluate_all_globals(Globals::TimeDependent);
  check_defaults();
}

Evaluator::~Evaluator() { sink_.set_chain(nullptr); }

// The chain

std::vector<ChainLink> Evaluator::chain() const {
  // Of a deep recursion, show the two ends.
  constexpr std::ptrdiff_t kMaxLinksAtAnEnd = 5;
  std::vector<ChainLink> links;
  for (auto step = steps_inside_.rbegin(); step != steps_inside_.rend(); ++step) {
    if (steps_inside_.rend() - step > kMaxLinksAtAnEnd &&
        step - steps_inside_.rbegin() >= kMaxLinksAtAnEnd) {
      const auto last = steps_inside_.rend() - kMaxLinksAtAnEnd;
      links.push_back({.where = links.back().where,
                       .message = fmt::format("{} more steps like this", last - step)});
      step = last;
    }
    const ast::Node node(*step->code->tree, step->node);
    ChainLink link{.where = node.head_location(), .message = {}};
    switch (step->kind) {
      case Step::Call: link.message = fmt::format("in `{}`", step->name); break;
      case Step::Instance: link.message = fmt::format("in `{}`", step->name); break;
      case Step::Group:
        link.message = step->name.empty() ? "in a group" : fmt::format("in group `{}`", step->name);
        break;
      case Step::Include:
        link.message = "included";
        link.where = node.location();
        break;
      case Step::Turn: {
        const Value& value = locals_[step->local].values[0];
        const auto* number = get_if<Scalar>(&value);
        link.message = number != nullptr
                           ? fmt::format("with {} = {}", step->name, to_text(number->value))
                           : fmt::format("with {} in turn {}", step->name, step->turn + 1);
        const auto name = node.first(SyntaxKind::Name);
        link.where = name ? name->location() : node.location();
        break;
      }
    }
    links.push_back(std::move(link));
  }
  return links;
}

// Settings

void Evaluator::find_settings() {
  const Module& root = program_.module(Program::kRoot);
  for (const ast::Node statement : ast::Node(root.tree, 0).children()) {
    if (!is_setting(root, statement)) continue;
    const ast::Object object{statement};
    const auto kinds = all_kinds();
    const auto kind = std::find_if(kinds.begin(), kinds.end(),
                                   [&](const Kind& k) { return k.name == object.kind(); });
    settings_.push_back({&*kind, object});
  }
  for (const Setting& setting : settings_) {
    if (setting.kind->is_unique) {
      const auto [first, is_new] =
          unique_.try_emplace(setting.kind->name, setting.node.kind_location());
      if (!is_new) {
        sink_.report(diag::duplicate, setting.node.kind_location(), "object", setting.kind->name)
            .label(first->second, "first given here");
      }
    }
    // Spheres' names are labels outside the namespace; cameras are picked by name.
    const auto name = setting.node.name();
    if (setting.kind->id != ObjectKind::Camera || !name) continue;
    const auto [first, is_new] = cameras_.try_emplace(name->text(), name->location());
    if (!is_new) {
      sink_.report(diag::duplicate, name->location(), "camera", name->text())
          .label(first->second, "first given here");
    }
  }
}

Code Evaluator::resolve(const Setting& setting) {
  Code code(setting.node.node.tree());
  std::uint32_t frame_size = 0;  // none: it holds expressions only
  Resolver(program_, Program::kRoot, sink_).resolve_statement(setting.node.node, code, frame_size);
  return code;
}

Value Evaluator::setting_value(const Setting& setting, std::size_t property) {
  const Code code = resolve(setting);
  const std::uint32_t expression = expression_of(code, code.statements.back(), property);
  if (expression == kNothing) return {};
  return property_value(code, setting.kind->properties[property], expression);
}

void Evaluator::find_animation() {
  for (const Setting& setting : settings_) {
    if (setting.kind->id != ObjectKind::Animation) continue;
    const Code code = resolve(setting);
    read_object(code, code.statements.back(), *setting.kind,
                code.operands_of(code.statements.back()));
    const auto frames = object_.get<render::Interval>(animation_property::kFrames);
    const auto fps = object_.get<double>(animation_property::kFps);
    const auto step = object_.get<double>(animation_property::kStep);
    if (!frames || !fps || !step) return;
    animation_ = {.first = static_cast<int>(frames->from),
                  .last = static_cast<int>(frames->to),
                  .step = static_cast<int>(*step),
                  .fps = *fps,
                  .where = object_.where};
    return;
  }
}

std::optional<std::string> Evaluator::chosen_camera() {
  if (options_.camera) return options_.camera;
  for (const Setting& setting : settings_) {
    if (setting.kind->id != ObjectKind::Render) continue;
    const Value camera = setting_value(setting, render_property::kCamera);
    if (const auto* word = get_if<Word>(&camera)) return word->text;
  }
  return std::nullopt;
}

void Evaluator::find_shutter() {
  const auto name = chosen_camera();
  for (const Setting& setting : settings_) {
    if (setting.kind->id != ObjectKind::Camera) continue;
    const auto own_name = setting.node.name();
    if (name && (!own_name || own_name->text() != *name)) continue;
    const Value shutter = setting_value(setting, camera_property::kShutter);
    const auto interval = value_as<render::Interval>(shutter);
    if (!interval) return;
    const double time = times_[0];
    times_ = {time + interval->from, time + interval->to};
    is_open_ = true;
    shutter_ = render::Interval{times_[0], times_[1]};
    return;
  }
}

void Evaluator::run_settings() {
  for (const Setting& setting : settings_) {
    const Code code = resolve(setting);
    const Statement& statement = code.statements.back();
    read_object(code, statement, *setting.kind, code.operands_of(statement));
    Slot& shutter = object_.slots[camera_property::kShutter];
    if (setting.kind->id == ObjectKind::Camera && shutter_ &&
        holds_alternative<Bounds>(shutter.value)) {
      shutter.value = Bounds{shutter_->from, shutter_->to, Unit::Time};
    }
    objects_->add(object_);
  }
}

// Globals

void Evaluator::evaluate_all_globals(Globals which) {
  std::vector<bool>& done = globals_done_[static_cast<std::size_t>(which)];
  done.assign(program_.module_count(), false);
  for (std::uint32_t module = 0; module < program_.module_count(); ++module) {
    evaluate_globals(module, which);
  }
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
  Varying value = evaluate_over_shutter(file.code, global.value);
  for (Value& moment : value.values) {
    moment = check_type(file, global.name, global.type, global.node, std::move(moment),
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

/// A literal default must have the parameter's type, even if no call needs it.
void Evaluator::check_defaults() {
  for (std::uint32_t i = 0; i < program_.module_count(); ++i) {
    const Module& file = program_.module(i);
    for (const std::vector<Definition>* list : {&file.functions, &file.defs}) {
      for (const Definition& definition : *list) {
        for (const Parameter& parameter : definition.parameters) check_default(file, parameter);
      }
    }
  }
}

void Evaluator::check_default(const Module& file, const Parameter& parameter) {
  const std::uint32_t expression = parameter.default_value;
  if (expression == kNothing) return;
  const Op op = file.code.expressions[expression].op;
  if (op != Op::Number && op != Op::Constant) return;
  check_type(file, parameter.name, parameter.type, parameter.node, evaluate(file.code, expression),
             place(file.code, expression));
}

// Files

void Evaluator::run(ObjectSink& objects) {
  objects_ = &objects;
  run_settings();
  run_file(Program::kRoot);
}

void Evaluator::run_file(std::uint32_t module) {
  const Module& file = program_.module(module);
  Code code(file.tree);
  Resolver resolver(program_, module, sink_);
  for (const ast::Node statement : ast::Node(file.tree, 0).children()) {
    if (is_declaration(statement.kind())) continue;
    const bool is_left_out = is_setting(file, statement);  // of an included file: checked, not used
    if (is_left_out && module == Program::kRoot) continue;
    std::uint32_t frame_size = 0;
    code.clear();
    const std::uint32_t index = resolver.resolve_statement(statement, code, frame_size);
    if (index == kNothing || is_left_out) continue;
    if (!open_frame(code, statement.index(), frame_size)) return;
    run(code, index);
    locals_.resize(frame_);
  }
}

}  // namespace sdlc::lang
