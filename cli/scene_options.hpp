#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "cli/diagnostics_output.hpp"
#include "cli/environment.hpp"
#include "lang/program/program.hpp"
#include "lang/source/limits.hpp"
#include "lang/source/source.hpp"

namespace sdlc::cli {

/// What every command that reads a scene is told of it.
struct SceneOptions {
  std::string file;
  std::string stdin_filename;
  std::vector<lang::SetOption> sets;
  lang::Limits limits;
  bool is_sandboxed = false;
  DiagnosticsOptions diagnostics;

  /// What the scene is called in messages, and where its own files are looked for.
  std::string name() const;
  /// The same; empty for standard input without --stdin-filename.
  std::string given_name() const;
};

void add_scene_options(CLI::App& command, SceneOptions& options);

/// The scene's text. Throws render::IoError.
lang::SourceFile read_source(const SceneOptions& options, const Environment& env);
lang::ProgramOptions program_options(const SceneOptions& options, const Environment& env);

}  // namespace sdlc::cli
