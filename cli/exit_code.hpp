#pragma once

#include <algorithm>
#include <array>

namespace sdlc::cli {

/// The exit status of the program; scripts depend on the values.
enum class ExitCode : int {
  Success = 0,
  Findings = 1,   ///< the scene has errors
  Usage = 2,      ///< wrong usage, or a file cannot be read or written
  Defect = 3,     ///< a bug in sdlc
  TryAgain = 75,  ///< trying again may help: a shard is missing, or the disk was full
  Interrupted = 130,
};

/// The more severe of two, for commands that do several things.
constexpr ExitCode graver(ExitCode a, ExitCode b) {
  constexpr std::array kAscending{ExitCode::Success,     ExitCode::TryAgain, ExitCode::Findings,
                                  ExitCode::Interrupted, ExitCode::Usage,    ExitCode::Defect};
  return std::max(a, b, [&](ExitCode x, ExitCode y) {
    return std::ranges::find(kAscending, x) < std::ranges::find(kAscending, y);
  });
}

}  // namespace sdlc::cli
