#include "cli/serve_scene.hpp"

#include <algorithm>
#include <sstream>
#include <string_view>

#include <fmt/format.h>

#include "cli/kernel_options.hpp"
#include "cli/override_options.hpp"
#include "cli/picture_memory.hpp"
#include "cli/report_failure.hpp"
#include "cli/scene_names.hpp"
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

namespace sdlc::cli {
namespace {

using lang::Program;

/// Larger pictures have no channels but the colour: they take 150 bytes a pixel.
constexpr std::size_t kMaxChannelPixels = 4'000'000;

std::string type_of(const lang::Global& param, const lang::Value& value) {
  if (param.type != nullptr) return std::string(param.type->name);
  const auto types = lang::all_types();
  const auto found =
      std::ranges::find_if(types, [&](const lang::TypeInfo& type) { return type.holds(value); });
  return found == types.end() ? std::string() : std::string(found->name);
}

/// Whether an expression has no other meaning as a value of --set, which knows only built-in names.
bool stands_alone(const lang::ast::Node& node, const lang::Module& root) {
  const std::string_view head = node.head();
  const std::string_view name = head.substr(0, head.find('.'));
  if ((node.is(lang::SyntaxKind::Reference) || node.is(lang::SyntaxKind::Call)) &&
      (root.global_names.contains(name) || root.function_names.contains(name) ||
       root.imports.contains(name))) {
    return false;
  }
  for (const lang::ast::Node part : node.children()) {
    if (!stands_alone(part, root)) return false;
  }
  return true;
}

bool is_plain_number(const lang::ast::Node& node) {
  if (!node.is(lang::SyntaxKind::Negative)) return node.is(lang::SyntaxKind::Number);
  const auto operand = node.child(0);
  return operand && operand->is(lang::SyntaxKind::Number);
}

/// A value as text that --set takes: as it is written, if that says the same there, and computed
/// numbers as their value, for a slider.
std::string set_text(const lang::Value& value, const lang::ast::Node& written,
                     const lang::Module& root) {
  if (const auto* text = lang::get_if<std::string>(&value)) return *text;
  const bool is_number =
      lang::get_if<lang::Scalar>(&value) != nullptr || lang::get_if<lang::Angle>(&value) != nullptr;
  const bool is_as_written = is_number ? is_plain_number(written) : stands_alone(written, root);
  if (is_as_written) return std::string(written.text());
  return lang::get_if<lang::Nothing>(&value) != nullptr ? std::string() : lang::to_text(value);
}

/// The params of a scene, with the values that they have without --set.
std::vector<ServedParam> read_params(const lang::Document& source, lang::ProgramOptions options,
                                     const lang::StopRequest& stop) {
  std::vector<ServedParam> params;
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
    std::optional<lang::ast::Node> written;
    for (const lang::ast::Node part : lang::ast::Node(root.tree, global.node).children()) {
      written = part;
    }
    const auto* const color = lang::get_if<render::LinearRgb>(&value);
    params.push_back(
        {.name = std::string(global.name),
         .type = type_of(global, value),
         .default_value = written ? set_text(value, *written, root) : std::string(),
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
  for (const lang::Diagnostic* finding : findings.shown) {
    std::ostringstream text;
    lang::make_diagnostic_writer({}, text)->write(*finding);
    scene.findings.push_back({.is_error = finding->info->severity == lang::Severity::Error,
                              .code = finding->info->code,
                              .message = finding->message,
                              .help = finding->help,
                              .text = text.str(),
                              .where = finding->where});
  }
}

/// Compiles the text; prepares nothing if it has errors.
void compile(const ServeOptions& options, ServeChoices& choices, const OnCorrect& on_correct,
             ServedScene& scene, Environment& env) {
  scene.source = read_scene(options.scene, env);
  if (scene.source->format() == lang::SourceFormat::Scene) {
    scene.params = read_params(*scene.source, program_options(options.scene, env), *scene.stop);
    scene.cameras = camera_names(*scene.source);
  }
  drop_unknown_params(scene.params, choices);
  scene.compiler.emplace(*scene.source, program_options(options, choices, env), scene.sink);
  scene.animation = scene.compiler->animation();
  if (!scene.animation) choices.frame.reset();
  if (choices.frame) {
    choices.frame = std::clamp(*choices.frame, scene.animation->first, scene.animation->last);
  }
  const lang::Overrides overrides = overrides_of(options, choices);
  auto lowered = scene.compiler->lower(overrides, choices.frame);
  if (!lowered) return;
  check_goals(overrides, *lowered);
  const bool has_channels = lowered->settings.window().pixels() <= kMaxChannelPixels;
  lowered->settings.keeps_first_hits = lowered->settings.keeps_variance = has_channels;
  check_picture_memory(lowered->settings, {.normal = has_channels, .depth = has_channels}, true);
  render::Kernel kernel = choose_kernel(options.kernel, overrides, *lowered, *scene.compiler);
  check_not_refused(kernel);
  scene.lowered = *std::move(lowered);
  scene.has_pose = overrides.pose.has_value();
  scene.prepared = on_correct(scene.lowered);
  if (scene.prepared) return;
  scene.prepared = std::make_shared<const render::PreparedScene>(
      std::move(kernel), scene.lowered.scene, scene.lowered.settings.threads);
}

std::string json_text(render::Vec3 point) {
  return fmt::format("[{}, {}, {}]", lang::to_text(point.x), lang::to_text(point.y),
                     lang::to_text(point.z));
}

std::string point_text(render::Vec3 point) {
  return lang::to_text(lang::Value(lang::Triple{point, lang::Unit::None}));
}

}  // namespace

std::unique_ptr<ServedScene> serve_scene(const ServeOptions& options, ServeChoices& choices,
                                         std::shared_ptr<const lang::StopRequest> stop,
                                         const OnCorrect& on_correct, Environment& env) {
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

bool are_same_file(const std::filesystem::path& a, const std::filesystem::path& b) {
  const lang::DiskFileSystem disk;
  return disk.identity(a) == disk.identity(b);
}

bool reads(const ServedScene& scene, const std::filesystem::path& path) {
  if (!scene.source) return false;
  const auto is_it = [&](const std::filesystem::path& file) { return are_same_file(file, path); };
  return is_it(scene.source->name()) ||
         (scene.compiler && std::ranges::any_of(scene.compiler->dependencies(), is_it));
}

std::string camera_text(const ServedScene& scene) {
  if (!scene.lowered.camera) return {};
  const render::Camera& camera = scene.lowered.scene.camera;
  if (scene.compiler->program() == nullptr) {
    return fmt::format("\"look_from\": {},\n\"look_at\": {}\n", json_text(camera.from),
                       json_text(camera.at));
  }
  const std::string from = point_text(camera.from), at = point_text(camera.at);
  for (const lang::ast::Node& statement :
       cameras_of(scene.compiler->program()->module(Program::kRoot).tree)) {
    if (name_of(statement) != scene.lowered.camera->name) continue;
    // The text as it is, with other values.
    std::string text(statement.text());
    if (!scene.has_pose) return text + "\n";
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
