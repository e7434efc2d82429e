#include "cli/diagnostics_output.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <span>
#include <string_view>
#include <system_error>

#include "cli/version.hpp"
#include "lang/explain/explain.hpp"

namespace sdlc::cli {
namespace {

struct NamedFormat {
  std::string_view name;
  lang::MessageFormat format;
  bool is_document;  ///< written even if there is nothing to report
};

/// Those that a command may use for its own output come first.
constexpr std::array<NamedFormat, 7> kFormats{{
    {"human", lang::MessageFormat::Human, false},
    {"concise", lang::MessageFormat::Concise, false},
    {"json", lang::MessageFormat::Json, true},
    {"sarif", lang::MessageFormat::Sarif, true},
    {"github", lang::MessageFormat::Github, false},
    {"gitlab", lang::MessageFormat::Gitlab, true},
    {"junit", lang::MessageFormat::Junit, true},
}};
constexpr std::size_t kAnswerFormats = 3;

constexpr auto kFormatNames = [] {
  std::array<std::string_view, kFormats.size()> names;
  std::ranges::transform(kFormats, names.begin(), &NamedFormat::name);
  return names;
}();
constexpr std::array<std::string_view, 3> kColors{"auto", "always", "never"};

/// Precondition: --format was checked.
const NamedFormat& format_of(const DiagnosticsOptions& options) {
  return *std::ranges::find(kFormats, options.format, &NamedFormat::name);
}

void add_options(Command& command, DiagnosticsOptions& options,
                 std::span<const std::string_view> formats) {
  command.add_text("--format", options.format, "Format of diagnostics").one_of(formats);
  command.add_text("--color", options.color, "Colours in diagnostics").one_of(kColors);
}

}  // namespace

void add_diagnostics_options(Command& command, DiagnosticsOptions& options) {
  add_options(command, options, kFormatNames);
}

void add_answer_options(Command& command, DiagnosticsOptions& options) {
  add_options(command, options, std::span(kFormatNames).first(kAnswerFormats));
}

bool wants_color(const DiagnosticsOptions& options, bool is_terminal, const Environment& env) {
  return options.color == "always" || (options.color == "auto" && is_terminal && !env.no_color);
}

std::unique_ptr<lang::DiagnosticWriter> make_writer(const DiagnosticsOptions& options,
                                                    std::ostream& out, bool is_terminal,
                                                    const Environment& env) {
  std::error_code no_folder;  // on failure names stay unchanged
  return lang::make_diagnostic_writer({.format = format_of(options).format,
                                       .color = wants_color(options, is_terminal, env),
                                       .facts = {.version = kVersion,
                                                 .root = std::filesystem::current_path(no_folder),
                                                 .page_of = lang::explanation}},
                                      out);
}

void print_findings(const lang::Findings& findings, const DiagnosticsOptions& options,
                    std::ostream& out, bool is_terminal, const Environment& env) {
  if (findings.shown.empty() && !format_of(options).is_document) return;
  const auto writer = make_writer(options, out, is_terminal, env);
  for (const lang::Diagnostic* diagnostic : findings.shown) writer->write(*diagnostic);
  writer->finish(findings.counts);
  out << std::flush;
}

}  // namespace sdlc::cli
