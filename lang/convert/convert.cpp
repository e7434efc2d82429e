#include "lang/convert/convert.hpp"

#include <algorithm>
#include <charconv>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "lang/convert/writers.hpp"
#include "lang/eval/eval.hpp"
#include "lang/format/format.hpp"
#include "lang/json/json.hpp"
#include "lang/lower/scene_builder.hpp"
#include "lang/syntax/syntax.hpp"

namespace sdlc::lang {
namespace {

/// Copies errors and warnings about rounded colours. Other warnings concern the text itself; `lint`
/// reports them.
void add_findings(const DiagnosticSink& from, DiagnosticSink& to) {
  for (const Diagnostic& diagnostic : from.diagnostics()) {
    const bool is_error = diagnostic.info->severity == Severity::Error;
    if (is_error || diagnostic.info == &diag::rounded_color) to.add(diagnostic);
  }
}

void collect_number(std::string_view spelling, std::vector<double>& numbers) {
  std::string digits(spelling);
  std::erase(digits, '_');
  double number = 0;
  const char* end = digits.data() + digits.size();
  const auto [stop, error] = std::from_chars(digits.data(), end, number);
  if (error == std::errc() && stop == end) numbers.push_back(number);
}

/// The number literals in calls of `linear255`, ascending. They are on the scale of configs, so the
/// config keeps them where it can.
std::vector<double> scaled_numbers(const SyntaxTree& tree) {
  std::vector<double> numbers;
  const auto nodes = tree.nodes();
  std::size_t end = 0;  // index of the first node after the call
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const SyntaxNode& node = nodes[i];
    const bool is_call = node.kind == SyntaxKind::Call &&
                         tree.text({node.begin, node.begin + node.head}) == "linear255";
    if (is_call) end = i + node.extent;
    if (i < end && node.kind == SyntaxKind::Number) collect_number(tree.text(node.span()), numbers);
  }
  std::ranges::sort(numbers);
  return numbers;
}

/// Throws std::logic_error unless the converted text lowers to the same picture.
void check_result(const Document& converted, const LoweredScene& lowered, bool compares_colors) {
  DiagnosticSink sink;
  SceneBuilder builder(converted, {}, sink, Purpose::Picture, Instancing::Never);
  if (converted.format() == SourceFormat::Json) {
    read_config(converted, builder, sink);
  } else {
    evaluate(converted, builder, sink);
  }
  const bool is_same = is_same_picture(lowered, builder.finish({}), compares_colors);
  if (is_same && !sink.has_errors()) return;
  const std::string reason = sink.has_errors() ? "; " + sink.diagnostics().front().message : "";
  throw std::logic_error("the converted text has another picture" + reason);
}

}  // namespace

Conversion::Conversion(const Document& file, const ProgramOptions& options, DiagnosticSink& sink)
    : file_(file), options_(options), sink_(sink) {
  if (file.format() == SourceFormat::Scene) {
    DiagnosticSink reading(sink.stop_request());
    program_ = std::make_unique<Program>(file, options, reading);
    add_findings(reading, sink);
  } else {
    for (const SetOption& set : options.sets) sink.report(diag::unknown_param, {}, set.name);
  }
}

Conversion::~Conversion() = default;

std::vector<std::filesystem::path> Conversion::dependencies() const {
  return program_ ? program_->dependencies() : std::vector<std::filesystem::path>{};
}

std::optional<std::string> Conversion::run(const ConvertOptions& options) {
  return program_ ? to_config(options) : to_scene();
}

std::optional<std::string> Conversion::to_scene() {
  LoweredScene lowered;
  {
    DiagnosticSink reading(sink_.stop_request());
    SceneBuilder builder(file_, options_.limits, reading, Purpose::Picture, Instancing::Never);
    if (check_file_size(file_, options_.limits, reading)) read_config(file_, builder, reading);
    lowered = builder.finish({});
    add_findings(reading, sink_);
  }
  if (sink_.has_errors()) return std::nullopt;

  const std::optional<std::string> text = scene_text(lowered);
  if (text) check_result(Document("converted.scene", *text), lowered, true);
  return text;
}

std::optional<std::string> Conversion::scene_text(const LoweredScene& lowered) {
  const Document unformatted("converted.scene", write_scene(file_, sink_, forced_warnings_));
  if (!check_limits(unformatted, lowered)) return std::nullopt;
  DiagnosticSink sink;
  return format_file(unformatted, sink).value_or("");
}

bool Conversion::check_limits(const SourceFile& scene, const LoweredScene& lowered) {
  const Limits& limits = options_.limits;
  const char* help = "the limit applies to the converted scene, not to the config";
  if (lowered.output.output.size() > limits.string) {
    sink_.report(diag::string_too_long, {&file_, {0, 0}}, limits.string).help(help);
  }
  if (scene.text().size() > limits.file) {
    sink_.report(diag::file_too_large, {&file_, {0, 0}}, limits.file).help(help);
  }
  return !sink_.has_errors();
}

std::optional<std::string> Conversion::to_config(const ConvertOptions& options) {
  Overrides overrides{.names_output = true};
  if (options.tone) overrides.render.emplace_back(render_property::kTone, *options.tone);
  if (options.camera) overrides.render.emplace_back(render_property::kCamera, *options.camera);
  DiagnosticSink reading(sink_.stop_request());
  SceneBuilder builder(file_, options_.limits, reading, Purpose::Picture, Instancing::Never);
  ConfigWriter writer(builder, options.camera,
                      scaled_numbers(program_->module(Program::kRoot).tree), reading);
  std::optional<Animation> film;
  LoweredScene lowered;
  {
    Evaluation evaluation(*program_, {.frame = options.frame, .camera = options.camera}, reading);
    film = evaluation.animation();
    if (film && !options.frame) {
      reading.report(diag::not_in_config, film->where, "a film")
          .help("`--frame N` converts one of its frames");
    }
    evaluation.run(writer);
    lowered = builder.finish(overrides);
  }
  if (options.frame && !film && !reading.has_errors()) {
    sink_.report(diag::no_effect, {}, "--frame").help("the scene has no `animation`");
  }
  std::string text = writer.finish(lowered, film ? options.frame : std::nullopt);
  add_findings(reading, sink_);
  if (sink_.has_errors()) return std::nullopt;

  check_result(Document("converted.json", text), lowered, writer.has_all_colors());
  return text;
}

bool is_same_picture(const LoweredScene& a, const LoweredScene& b, bool compares_colors) {
  const render::Camera &ca = a.scene.camera, &cb = b.scene.camera;
  const render::Background &ba = a.scene.background, &bb = b.scene.background;
  const bool has_same_view = ca.from == cb.from && ca.at == cb.at && ca.up == cb.up &&
                             ca.plane_height == cb.plane_height && ca.aspect == cb.aspect &&
                             ca.aperture == cb.aperture && (!ca.has_lens() || ca.focus == cb.focus);
  const bool has_same_settings =
      a.settings.width == b.settings.width && a.settings.height == b.settings.height &&
      a.settings.samples == b.settings.samples && a.settings.depth == b.settings.depth &&
      a.settings.seed == b.settings.seed && a.output.mapping == b.output.mapping;
  const bool has_same_colors = !compares_colors || (a.scene.materials == b.scene.materials &&
                                                    ba.bottom == bb.bottom && ba.top == bb.top);
  return (has_same_view || !a.camera) && has_same_settings && has_same_colors &&
         a.scene.spheres == b.scene.spheres && a.scene.shifts == b.scene.shifts;
}

}  // namespace sdlc::lang
