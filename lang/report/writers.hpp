#pragma once

#include <memory>
#include <ostream>
#include <string>
#include <string_view>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/report/report.hpp"

/// The writers for make_diagnostic_writer(), and what they share.
namespace sdlc::lang {

/// "error" or "warning".
std::string_view severity_name(Severity severity) noexcept;

/// The message, then `; did you mean X?` if there is a suggestion. Not yet safe for a terminal.
std::string message_with_suggestion(const Diagnostic& diagnostic);

/// The message about findings that are not listed.
std::string omitted_text(std::size_t omitted);

std::unique_ptr<DiagnosticWriter> make_human_writer(std::ostream& out, bool has_color);
std::unique_ptr<DiagnosticWriter> make_json_writer(std::ostream& out);
std::unique_ptr<DiagnosticWriter> make_sarif_writer(std::ostream& out, ReportFacts facts);
std::unique_ptr<DiagnosticWriter> make_github_writer(std::ostream& out, ReportFacts facts);
std::unique_ptr<DiagnosticWriter> make_gitlab_writer(std::ostream& out, ReportFacts facts);
std::unique_ptr<DiagnosticWriter> make_junit_writer(std::ostream& out, ReportFacts facts);

}  // namespace sdlc::lang
