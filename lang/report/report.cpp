#include "lang/report/report.hpp"

#include <sstream>

#include <fmt/format.h>

#include "lang/report/writers.hpp"
#include "lang/text/display_width.hpp"

namespace sdlc::lang {
namespace {

std::string render_concise(const Diagnostic& diagnostic) {
  std::string line;
  if (diagnostic.where.file != nullptr) line = describe_place(diagnostic.where) + ": ";
  line += fmt::format("{}[{}]: {}", severity_name(diagnostic.info->severity), diagnostic.info->code,
                      message_with_suggestion(diagnostic));
  return printable(line) + "\n";
}

class ConciseWriter final : public DiagnosticWriter {
 public:
  explicit ConciseWriter(std::ostream& out) : out_(out) {}

  void write(const Diagnostic& diagnostic) override { out_ << render_concise(diagnostic); }
  void finish(const DiagnosticCounts& /*counts*/) override {}

 private:
  std::ostream& out_;
};

}  // namespace

std::string_view severity_name(Severity severity) noexcept {
  return severity == Severity::Error ? "error" : "warning";
}

std::string message_with_suggestion(const Diagnostic& diagnostic) {
  if (diagnostic.suggestion.empty()) return diagnostic.message;
  return fmt::format("{}; did you mean {}?", diagnostic.message, diagnostic.suggestion);
}

std::string omitted_text(std::size_t omitted) {
  return fmt::format(
      "{} more finding{} not listed: the limit is {} errors and {} warnings per file", omitted,
      omitted == 1 ? " is" : "s are", FindingsFilter::kMaxShown, FindingsFilter::kMaxShown);
}

std::string describe_place(const Location& where) {
  const Position position = where.file->position(where.span.begin);
  return fmt::format("{}:{}:{}", printable(where.file->name()), position.line, position.column);
}

std::unique_ptr<DiagnosticWriter> make_diagnostic_writer(const RenderDiagnosticsOptions& options,
                                                         std::ostream& out) {
  switch (options.format) {
    case MessageFormat::Human: return make_human_writer(out, options.color);
    case MessageFormat::Json: return make_json_writer(out);
    case MessageFormat::Sarif: return make_sarif_writer(out, options.facts);
    case MessageFormat::Github: return make_github_writer(out, options.facts);
    case MessageFormat::Gitlab: return make_gitlab_writer(out, options.facts);
    case MessageFormat::Junit: return make_junit_writer(out, options.facts);
    case MessageFormat::Concise: break;
  }
  return std::make_unique<ConciseWriter>(out);
}

std::string render_findings(const Findings& findings, const RenderDiagnosticsOptions& options) {
  std::ostringstream text;
  const auto writer = make_diagnostic_writer(options, text);
  for (const Diagnostic* diagnostic : findings.shown) writer->write(*diagnostic);
  writer->finish(findings.counts);
  return std::move(text).str();
}

std::string render_diagnostics(const DiagnosticSink& sink,
                               const RenderDiagnosticsOptions& options) {
  return render_findings(select_findings(sink), options);
}

}  // namespace sdlc::lang
