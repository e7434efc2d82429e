#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include "cli/environment.hpp"
#include "lang/diagnostics/diagnostics.hpp"

namespace sdlc::cli {

/// The flags of every command that reports diagnostics.
struct DiagnosticsOptions {
  std::string format = "human";
  std::string color = "auto";
};

void add_diagnostics_options(CLI::App& command, DiagnosticsOptions& options);

/// The sink's diagnostics to `out` in the format asked for; nothing when there are none.
void print_diagnostics(const lang::DiagnosticSink& sink, const DiagnosticsOptions& options,
                       std::ostream& out, bool is_terminal, const Environment& env);

}  // namespace sdlc::cli
