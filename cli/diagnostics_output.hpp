#pragma once

#include <memory>
#include <ostream>
#include <string>

#include "cli/command_line.hpp"
#include "cli/environment.hpp"
#include "lang/diagnostics/diagnostics.hpp"
#include "lang/report/findings.hpp"
#include "lang/report/report.hpp"

namespace sdlc::cli {

/// The flags of every command that reports diagnostics.
struct DiagnosticsOptions {
  std::string format = "human";
  std::string color = "auto";
};

void add_diagnostics_options(Command& command, DiagnosticsOptions& options);

/// The same for a command whose own output also has the chosen format: human, concise or json.
void add_answer_options(Command& command, DiagnosticsOptions& options);

/// Whether to use colours, from --color, NO_COLOR and the kind of output.
bool wants_color(const DiagnosticsOptions& options, bool is_terminal, const Environment& env);

/// Writes to `out`, which must outlive the writer, in the chosen format.
std::unique_ptr<lang::DiagnosticWriter> make_writer(const DiagnosticsOptions& options,
                                                    std::ostream& out, bool is_terminal,
                                                    const Environment& env);

/// Writes the findings to `out` in the requested format. Without findings, only formats that are
/// documents write anything.
void print_findings(const lang::Findings& findings, const DiagnosticsOptions& options,
                    std::ostream& out, bool is_terminal, const Environment& env);

}  // namespace sdlc::cli
