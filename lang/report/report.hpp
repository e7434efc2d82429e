#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <ostream>
#include <string>
#include <string_view>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/report/findings.hpp"

namespace sdlc::lang {

enum class MessageFormat : std::uint8_t { Human, Concise, Json, Sarif, Github, Gitlab, Junit };

/// Additional contents of the formats for other programs: Sarif, Github, Gitlab and Junit.
struct ReportFacts {
  std::string version = {};  ///< of sdlc
  /// Files in this folder are named by their paths relative to it; if empty, as the user named
  /// them.
  std::filesystem::path root = {};
  /// The Markdown page that explains a code; nullopt if there is none.
  std::function<std::optional<std::string_view>(std::string_view code)> page_of = {};
};

struct RenderDiagnosticsOptions {
  MessageFormat format = MessageFormat::Human;
  bool color = false;  ///< ANSI colours, for the human format
  ReportFacts facts = {};
};

/// "file:line:column" of the beginning of the span, safe for a terminal.
std::string describe_place(const Location& where);

/// Writes diagnostics as text.
///
/// * Human shows the source line with carets under the span, labels, help and a closing count.
/// * Concise is one line per diagnostic, `file:line:col: severity[CODE]: message`, then
///   `; did you mean X?` if there is a suggestion.
/// * Json is one object with arrays `diagnostics` and `failures`.
/// * Sarif is a SARIF 2.1.0 log with one run, for code scanning of GitHub.
/// * Github is one workflow command per diagnostic, which GitHub Actions shows at the line.
/// * Gitlab is a Code Quality report.
/// * Junit is a suite per file and a failed case per diagnostic, for viewers of test results.
class DiagnosticWriter {
 public:
  virtual ~DiagnosticWriter() = default;

  /// Begins a file, as the user named it. Its diagnostics may be in other files.
  virtual void enter(const std::string& /*name*/) {}
  virtual void write(const Diagnostic& diagnostic) = 0;
  /// Reports that a file could not be read or written. Formats for people ignore this, because the
  /// message is on standard error.
  virtual void fail(const std::string& /*name*/, const std::string& /*reason*/) {}
  /// Writes the end of the report.
  virtual void finish(const DiagnosticCounts& counts) = 0;
};

/// `out` must outlive the writer.
std::unique_ptr<DiagnosticWriter> make_diagnostic_writer(const RenderDiagnosticsOptions& options,
                                                         std::ostream& out);

/// The findings as text.
std::string render_findings(const Findings& findings, const RenderDiagnosticsOptions& options);

/// All findings of the sink as text, without a filter.
std::string render_diagnostics(const DiagnosticSink& sink, const RenderDiagnosticsOptions& options);

}  // namespace sdlc::lang
