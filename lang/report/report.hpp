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

/// What reports for other programs (Sarif and those behind it) hold besides the diagnostics.
struct ReportFacts {
  std::string version = {};  ///< of sdlc
  /// Files in this folder are called by their paths from it; empty: as the user named them.
  std::filesystem::path root = {};
  /// The page of Markdown that explains a code; nothing where there is none.
  std::function<std::optional<std::string_view>(std::string_view code)> page_of = {};
};

struct RenderDiagnosticsOptions {
  MessageFormat format = MessageFormat::Human;
  bool color = false;  ///< ANSI colours; only the human format has any
  ReportFacts facts = {};
};

/// "file:line:column" of where the span begins, as it may be printed.
std::string describe_place(const Location& where);

/// Writes diagnostics as text.
///
/// * Human shows the source line with carets under the span, labels, help and a closing count.
/// * Concise is one line each, `file:line:col: severity[CODE]: message`, then `; did you mean X?`
///   where there is a suggestion.
/// * Json is one object with arrays `diagnostics` and `failures`.
/// * Sarif is a log of SARIF 2.1.0 with one run, as code scanning of GitHub reads it.
/// * Github is one workflow command each, which GitHub Actions shows at the line.
/// * Gitlab is a Code Quality report.
/// * Junit is a suite a file and a failed case a diagnostic, for whatever shows results of tests.
class DiagnosticWriter {
 public:
  virtual ~DiagnosticWriter() = default;

  /// The file that is looked at from now on, as the user named it; what is found may be in others.
  virtual void enter(const std::string& /*name*/) {}
  virtual void write(const Diagnostic& diagnostic) = 0;
  /// The file that the user named could not be looked at. People read of it on standard error; a
  /// report that programs read says it too.
  virtual void fail(const std::string& /*name*/, const std::string& /*reason*/) {}
  /// Writes what stands behind all of them.
  virtual void finish(const DiagnosticCounts& counts) = 0;
};

/// `out` must outlive the writer.
std::unique_ptr<DiagnosticWriter> make_diagnostic_writer(const RenderDiagnosticsOptions& options,
                                                         std::ostream& out);

/// The findings as text.
std::string render_findings(const Findings& findings, const RenderDiagnosticsOptions& options);

/// The findings of the sink without a filter, as text.
std::string render_diagnostics(const DiagnosticSink& sink, const RenderDiagnosticsOptions& options);

}  // namespace sdlc::lang
