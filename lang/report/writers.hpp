#pragma once

#include <memory>
#include <ostream>
#include <string>
#include <string_view>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/report/report.hpp"

/// The writers behind make_diagnostic_writer.
namespace sdlc::lang {

/// "error" or "warning".
std::string_view severity_name(Severity severity) noexcept;

/// The message, and `; did you mean X?` where there is a suggestion; not fit for a terminal yet.
std::string message_with_suggestion(const Diagnostic& diagnostic);

/// How a report says that so many were not kept.
std::string omitted_text(std::size_t omitted);

std::unique_ptr<DiagnosticWriter> make_human_writer(std::ostream& out, bool has_color);
std::unique_ptr<DiagnosticWriter> make_json_writer(std::ostream& out);
std::unique_ptr<DiagnosticWriter> make_sarif_writer(std::ostream& out, ReportFacts facts);
std::unique_ptr<DiagnosticWriter> make_github_writer(std::ostream& out, ReportFacts facts);
std::unique_ptr<DiagnosticWriter> make_gitlab_writer(std::ostream& out, ReportFacts facts);
std::unique_ptr<DiagnosticWriter> make_junit_writer(std::ostream& out, ReportFacts facts);

}  // namespace sdlc::lang
