#pragma once

namespace sdlc::cli {

/// What the program's exit status says; scripts depend on it.
enum class ExitCode : int {
  Success = 0,
  Findings = 1,  ///< the scene has errors
  Usage = 2,     ///< wrong usage, or a file cannot be read or written
  Defect = 3,    ///< a fault of sdlc itself
  Interrupted = 130,
};

}  // namespace sdlc::cli
