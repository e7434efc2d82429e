#pragma once

#include <cstdio>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>
#include <sys/wait.h>

#include "tests/support/temporary_folder.hpp"

namespace sdlc::test {

/// How a run of the real program ended.
struct ProgramResult {
  int exit_code = -1;  ///< as a shell sees it: 128 + n for signal n
  std::string out, err;
};

/// Runs a shell command in `folder` with the program as "$SDLC".
inline ProgramResult run_shell(const std::filesystem::path& folder, const std::string& command) {
  const TemporaryFolder logs;
  // The command's redirections are its own; what it leaves alone goes to the logs.
  const std::string line = "cd '" + folder.string() + "' && SDLC='" SDLC_PROGRAM "' && ( " +
                           command + "\n) >'" + (logs / "out").string() + "' 2>'" +
                           (logs / "err").string() + "' </dev/null";
  const int status = std::system(line.c_str());
  return {.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status),
          .out = content_of(logs / "out"),
          .err = content_of(logs / "err")};
}

/// Whether the shell finds a program. A test that needs more than coreutils asks, and is skipped
/// with a message; `./dev test` installs what tests ask for.
inline bool has_program(const std::string& name) {
  return run_shell(TemporaryFolder().path(), "command -v " + name).exit_code == 0;
}

}  // namespace sdlc::test
