#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "lang/report/report_place.hpp"
#include "lang/report/writers.hpp"
#include "lang/text/display_width.hpp"

namespace sdlc::lang {
namespace {

/// Escapes the message of a workflow command.
std::string escaped_for_log(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '%': result += "%25"; break;
      case '\r': result += "%0D"; break;
      case '\n': result += "%0A"; break;
      default: result += c;
    }
  }
  return result;
}

/// Escapes the value of a property of a workflow command.
std::string escaped_property(std::string_view text) {
  std::string result;
  for (const char c : escaped_for_log(text)) {
    switch (c) {
      case ':': result += "%3A"; break;
      case ',': result += "%2C"; break;
      default: result += c;
    }
  }
  return result;
}

/// The message, then one line per help.
std::string message_lines(const Diagnostic& diagnostic) {
  std::string text = printable(message_with_suggestion(diagnostic));
  for (const std::string& line : diagnostic.help) text += "\nhelp: " + printable(line);
  return text;
}

class GithubWriter final : public DiagnosticWriter {
 public:
  GithubWriter(std::ostream& out, ReportFacts facts) : out_(out), facts_(std::move(facts)) {}

  void write(const Diagnostic& diagnostic) override {
    const bool is_error = diagnostic.info->severity == Severity::Error;
    std::string properties, message = message_lines(diagnostic);
    if (diagnostic.where.file != nullptr) {
      properties = place_properties(diagnostic.where);
      // The log shows only the message, so it includes the place.
      message.insert(0, describe_place(diagnostic.where) + ": ");
    }
    out_ << fmt::format(
        "::{} {}title={}::{}\n", is_error ? "error" : "warning", properties,
        escaped_property(fmt::format("sdlc {} {}", diagnostic.info->code, diagnostic.info->name)),
        escaped_for_log(message));
  }

  void fail(const std::string& name, const std::string& reason) override {
    out_ << fmt::format("::error file={},title=sdlc::{}\n",
                        escaped_property(printable(report_path(name, facts_.root))),
                        escaped_for_log(printable(reason)));
  }

  void finish(const DiagnosticCounts& counts) override {
    if (counts.omitted > 0) out_ << fmt::format("::notice::{}\n", omitted_text(counts.omitted));
  }

 private:
  /// Columns only for a span within a line: GitHub rejects them otherwise.
  std::string place_properties(const Location& where) const {
    const auto [line, column] = where.file->position(where.span.begin);
    const auto [end_line, end_column] = where.file->position(where.span.end);
    const std::string columns =
        line == end_line ? fmt::format("col={},endColumn={},", column, end_column) : "";
    return fmt::format("file={},line={},endLine={},{}",
                       escaped_property(printable(report_path(where.file->name(), facts_.root))),
                       line, end_line, columns);
  }

  std::ostream& out_;
  ReportFacts facts_;
};

}  // namespace

std::unique_ptr<DiagnosticWriter> make_github_writer(std::ostream& out, ReportFacts facts) {
  return std::make_unique<GithubWriter>(out, std::move(facts));
}

}  // namespace sdlc::lang
