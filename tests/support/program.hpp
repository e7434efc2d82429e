#pragma once

#include <cstdio>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>
#include <sys/wait.h>

#include "tests/support/temporary_folder.hpp"

namespace sdlc::test {

/// The result of a run of the real program.
struct ProgramResult {
  int exit_code = -1;  ///< as in a shell: 128 + n for signal n
  std::string out, err;
};

/// Runs a shell command in `folder` with the program as "$SDLC".
inline ProgramResult run_shell(const std::filesystem::path& folder, const std::string& command) {
  const TemporaryFolder logs;
  // Redirections in the command take precedence; everything else goes to the logs.
  const std::string line = "cd '" + folder.string() + "' && SDLC='" SDLC_PROGRAM "' && ( " +
                           command + "\n) >'" + (logs / "out").string() + "' 2>'" +
                           (logs / "err").string() + "' </dev/null";
  const int status = std::system(line.c_str());
  return {.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status),
          .out = content_of(logs / "out"),
          .err = content_of(logs / "err")};
}

/// Whether the shell finds a program. Tests that need more than coreutils check this, and are
/// skipped with a message; `./dev test` installs the programs.
inline bool has_program(const std::string& name) {
  return run_shell(TemporaryFolder().path(), "command -v " + name).exit_code == 0;
}

}  // namespace sdlc::test
