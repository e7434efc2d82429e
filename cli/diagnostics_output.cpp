#include "cli/diagnostics_output.hpp"

#include <array>

#include "cli/words.hpp"
#include "lang/diagnostics/render.hpp"

namespace sdlc::cli {
namespace {

constexpr std::array<std::string_view, 3> kFormats{"human", "concise", "json"};
constexpr std::array<std::string_view, 3> kColors{"auto", "always", "never"};

}  // namespace

void add_diagnostics_options(CLI::App& command, DiagnosticsOptions& options) {
  command.add_option("--format", options.format, "How diagnostics are printed")
      ->check(one_of(kFormats));
  command.add_option("--color", options.color, "Colours in diagnostics")->check(one_of(kColors));
}

void print_diagnostics(const lang::DiagnosticSink& sink, const DiagnosticsOptions& options,
                       std::ostream& out, bool is_terminal, const Environment& env) {
  if (sink.diagnostics().empty() && options.format != "json") return;
  lang::RenderDiagnosticsOptions rendering;
  if (options.format == "concise") rendering.format = lang::MessageFormat::Concise;
  if (options.format == "json") rendering.format = lang::MessageFormat::Json;
  rendering.color =
      options.color == "always" || (options.color == "auto" && is_terminal && !env.no_color);
  out << lang::render_diagnostics(sink, rendering) << std::flush;
}

}  // namespace sdlc::cli
