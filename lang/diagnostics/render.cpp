#include "lang/diagnostics/render.hpp"

#include <fmt/format.h>

#include "lang/diagnostics/formats.hpp"
#include "lang/text/display_width.hpp"

namespace sdlc::lang {
namespace {

std::string render_concise(const Diagnostic& diagnostic) {
  std::string line;
  if (diagnostic.where.file != nullptr) line = describe_place(diagnostic.where) + ": ";
  line += fmt::format("{}[{}]: {}", severity_name(diagnostic.info->severity), diagnostic.info->code,
                      diagnostic.message);
  if (!diagnostic.suggestion.empty()) {
    line += fmt::format("; did you mean {}?", diagnostic.suggestion);
  }
  return printable(line) + "\n";
}

}  // namespace

std::string_view severity_name(Severity severity) noexcept {
  return severity == Severity::Error ? "error" : "warning";
}

std::string describe_place(const Location& where) {
  const Position position = where.file->position(where.span.begin);
  return fmt::format("{}:{}:{}", printable(where.file->name()), position.line, position.column);
}

std::string render_diagnostics(const DiagnosticSink& sink,
                               const RenderDiagnosticsOptions& options) {
  switch (options.format) {
    case MessageFormat::Human: return render_human(sink, options.color);
    case MessageFormat::Json: return render_json(sink);
    case MessageFormat::Concise: break;
  }
  std::string text;
  for (const Diagnostic* diagnostic : sink.sorted()) text += render_concise(*diagnostic);
  return text;
}

}  // namespace sdlc::lang
