#include "cli/serve_scene.hpp"

#include <algorithm>
#include <sstream>
#include <string_view>

#include <fmt/format.h>

#include "cli/kernel_options.hpp"
#include "cli/override_options.hpp"
#include "cli/picture_memory.hpp"
#include "cli/report_failure.hpp"
#include "lang/allowances/allowances.hpp"
#include "lang/ast/ast.hpp"
#include "lang/editor/value_text.hpp"
#include "lang/eval/value_probe.hpp"
#include "lang/object/value.hpp"
#include "lang/report/report.hpp"
#include "lang/resolve/module.hpp"
#include "lang/resolve/symbol_table.hpp"
#include "lang/schema/schema.hpp"
#include "lang/value/types.hpp"
#include "render/math/clock.hpp"

namespace sdlc::cli {
namespace {

using lang::Program;

std::string type_of(const lang::Global& param, const lang::Value& value) {
  if (param.type != nullptr) return std::string(param.type->name);
  const auto types = lang::all_types();
  const auto found =
      std::ranges::find_if(types, [&](const lang::TypeInfo& type) { return type.holds(value); });
  return found == types.end() ? std::string() : std::string(found->name);
}

/// The params of a scene, with the values that they have without --set.
std::vector<ServedParam> read_params(const lang::Document& source, lang::ProgramOptions options,
                                     const lang::StopRequest& stop) {
  std::vector<ServedParam> params;
  if (source.format() != lang::SourceFormat::Scene) return params;
  options.sets.clear();
  lang::DiagnosticSink ignored(&stop);
  Program program(source, options, ignored);
  const lang::Module& root = program.module(Program::kRoot);
  lang::ValueProbe probe(program, lang::ValueProbe::kSteps, &stop);
  for (std::uint32_t i = 0; i < root.globals.size(); ++i) {
    const lang::Global& global = root.globals[i];
    if (!global.is_param) continue;
    const lang::Value value = probe.global(Program::kRoot, i).value;
    const lang::SymbolTable& names = program.names_of(Program::kRoot, &stop);
    const lang::Symbol* const symbol = names.find(global.node);
    const lang::ast::Node statement(root.tree, global.node);
    std::string_view written;
    for (const lang::ast::Node part : statement.children()) written = part.text();
    const auto* const color = lang::get_if<render::LinearRgb>(&value);
    const bool is_known = lang::get_if<lang::Nothing>(&value) == nullptr;
    params.push_back(
        {.name = std::string(global.name),
         .type = type_of(global, value),
         .written = std::string(written),
         .default_value = is_known ? lang::to_text(value) : std::string(),
         .hex = color != nullptr ? lang::nearest_hex(*color).value_or("") : std::string(),
         .documentation = symbol != nullptr ? names.documentation_of(*symbol) : std::string()});
  }
  return params;
}

/// So that a param may be renamed while it has a value.
void drop_unknown_params(const std::vector<ServedParam>& params, ServeChoices& choices) {
  std::erase_if(choices.params, [&](const auto& choice) {
    return std::ranges::find(params, choice.first, &ServedParam::name) == params.end();
  });
}

lang::ProgramOptions program_options(const ServeOptions& options, const ServeChoices& choices,
                                     const Environment& env) {
  lang::ProgramOptions program = program_options(options.scene, env);
  std::erase_if(program.sets,
                [&](const lang::SetOption& set) { return choices.params.contains(set.name); });
  for (const auto& [name, value] : choices.params) program.sets.push_back({name, value});
  return program;
}

lang::Overrides overrides_of(const ServeOptions& options, const ServeChoices& choices) {
  lang::Overrides overrides = options.overrides;
  if (choices.camera) {
    std::erase_if(overrides.render, [](const lang::Override& flag) {
      return flag.property == lang::render_property::kCamera;
    });
    overrides.render.emplace_back(lang::render_property::kCamera, *choices.camera);
  }
  overrides.pose = choices.pose;
  overrides.names_output = true;
  overrides.instancing = instancing_for(options.kernel, overrides);
  return overrides;
}

void take_findings(ServedScene& scene) {
  const lang::Findings findings = lang::select_unallowed(scene.sink);
  scene.errors = findings.counts.errors;
  scene.warnings = findings.counts.warnings;
  for (const lang::Diagnostic* finding : findings.shown) {
    std::ostringstream text;
    lang::make_diagnostic_writer({}, text)->write(*finding);
    scene.findings.push_back({.is_error = finding->info->severity == lang::Severity::Error,
                              .code = std::string(finding->info->code),
                              .text = text.str(),
                              .where = finding->where});
  }
}

/// Compiles the text; prepares nothing if it has errors.
void compile(const ServeOptions& options, ServeChoices& choices,
             const std::function<void()>& on_correct, ServedScene& scene, Environment& env) {
  const auto start = render::Clock::now();
  scene.source = read_scene(options.scene, env);
  scene.params = read_params(*scene.source, program_options(options.scene, env), *scene.stop);
  drop_unknown_params(scene.params, choices);
  scene.compiler.emplace(*scene.source, program_options(options, choices, env), scene.sink);
  scene.animation = scene.compiler->animation();
  if (!scene.animation) choices.frame.reset();
  if (choices.frame) {
    choices.frame = std::clamp(*choices.frame, scene.animation->first, scene.animation->last);
  }
  const lang::Overrides overrides = overrides_of(options, choices);
  auto lowered = scene.compiler->lower(overrides, choices.frame);
  scene.compile_seconds = render::seconds_since(start);
  if (!lowered) return;
  check_goals(overrides, *lowered);
  lowered->settings.keeps_first_hits = true;
  lowered->settings.keeps_variance = true;
  check_picture_memory(lowered->settings, {.normal = true, .depth = true, .albedo = true}, true);
  const auto build_start = render::Clock::now();
  render::Kernel kernel = choose_kernel(options.kernel, overrides, *lowered, *scene.compiler);
  check_not_refused(kernel);
  scene.lowered = *std::move(lowered);
  on_correct();
  scene.prepared = std::make_shared<const render::PreparedScene>(
      std::move(kernel), scene.lowered.scene, scene.lowered.settings.threads);
  scene.build_seconds = render::seconds_since(build_start);
}

std::string point_text(render::Vec3 point) {
  return lang::to_text(lang::Value(lang::Triple{point, lang::Unit::None}));
}

}  // namespace

std::unique_ptr<ServedScene> serve_scene(const ServeOptions& options, ServeChoices& choices,
                                         std::shared_ptr<const lang::StopRequest> stop,
                                         const std::function<void()>& on_correct,
                                         Environment& env) {
  auto scene = std::make_unique<ServedScene>(std::move(stop));
  std::ostringstream messages;
  Environment quiet = env.with_err(messages);
  report_failure(quiet, [&] {
    compile(options, choices, on_correct, *scene, quiet);
    return ExitCode::Success;
  });
  take_findings(*scene);
  scene->failure = messages.str();
  return scene;
}

std::string camera_text(const ServedScene& scene) {
  if (!scene.lowered.camera) return {};
  const render::Camera& camera = scene.lowered.scene.camera;
  const std::string from = point_text(camera.from), at = point_text(camera.at);
  const std::string& name = scene.lowered.camera->name;
  const lang::ast::Node file(scene.compiler->program()->module(Program::kRoot).tree, 0);
  for (const lang::ast::Node statement : file.children()) {
    if (!statement.is(lang::SyntaxKind::Object) || statement.head() != "camera") continue;
    const auto written = statement.first(lang::SyntaxKind::Name);
    if (written ? written->text() != name : !name.empty()) continue;
    // The text as it is, with other values.
    std::string text(statement.text());
    std::size_t shift = statement.span().begin, replaced = 0;
    for (const lang::ast::Node property : statement.children()) {
      if (!property.is(lang::SyntaxKind::Property)) continue;
      const auto value = lang::ast::Labeled{property}.value();
      const bool is_from = property.head() == "from";
      if (!value || !(is_from || property.head() == "at")) continue;
      const std::string& now = is_from ? from : at;
      text.replace(value->span().begin - shift, value->span().size(), now);
      shift += value->span().size() - now.size();
      ++replaced;
    }
    if (replaced == 2) return text + "\n";
  }
  return fmt::format("from: {}, at: {}\n", from, at);
}

}  // namespace sdlc::cli
