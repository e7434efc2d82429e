#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "cli/command_line.hpp"
#include "cli/diagnostics_output.hpp"
#include "cli/environment.hpp"
#include "cli/scene_pack.hpp"
#include "lang/program/program.hpp"
#include "lang/source/limits.hpp"
#include "lang/workspace/document.hpp"

namespace sdlc::cli {

/// How scenes are read.
struct ReadingOptions {
  std::string stdin_filename;
  lang::Limits limits;
  bool is_sandboxed = false;
};

/// --limit NAME=N
void add_limit_option(Command& command, lang::Limits& limits);

void add_reading_options(Command& command, ReadingOptions& options);

/// The name of a scene from standard input in messages.
std::string stdin_name(const ReadingOptions& options);

/// Reads `path`, called `name` in messages; at most the first `max_bytes` + 1 bytes. Throws
/// render::IoError.
std::shared_ptr<const lang::Document> read_document(
    const std::string& path, const std::string& name, const Environment& env,
    std::uint64_t max_bytes = lang::Limits().any_file());

lang::ProgramOptions program_options(const ReadingOptions& options, const Environment& env);

/// Options of a command that reads one scene.
struct SceneOptions {
  std::string file;                      ///< in a pack: its path there, `ball.sdlc.zip/ball.scene`
  std::shared_ptr<ScenePack> pack = {};  ///< that `file` is in; null for a file on disk
  std::vector<lang::SetOption> sets;
  ReadingOptions reading;
  DiagnosticsOptions diagnostics;

  /// The name of the scene in messages; relative files are looked up from it.
  std::string name() const;
  /// The same; empty for standard input without --stdin-filename.
  std::string given_name() const;
  /// The file on disk that has the scene: itself, or its pack.
  const std::string& disk_file() const { return pack ? pack->path() : file; }
};

/// --set NAME=VALUE
void add_set_option(Command& command, std::vector<lang::SetOption>& sets);

void add_scene_options(Command& command, SceneOptions& options);

/// Throws render::IoError for a pipe, a device or the like, which cannot be replaced.
void refuse_special(const std::string& path, const Environment& env);

/// If the file is a pack, goes on with the scene in it. Throws render::IoError.
void enter_pack(SceneOptions& options, const Environment& env);

/// Throws render::IoError.
std::shared_ptr<const lang::Document> read_scene(const SceneOptions& options,
                                                 const Environment& env);
lang::ProgramOptions program_options(const SceneOptions& options, const Environment& env);

}  // namespace sdlc::cli
