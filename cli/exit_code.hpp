#pragma once

#include <algorithm>
#include <array>

namespace sdlc::cli {

/// What the program's exit status says; scripts depend on it.
enum class ExitCode : int {
  Success = 0,
  Findings = 1,  ///< the scene has errors
  Usage = 2,     ///< wrong usage, or a file cannot be read or written
  Defect = 3,    ///< a fault of sdlc itself
  Interrupted = 130,
};

/// The graver of two, where a command does several things.
constexpr ExitCode graver(ExitCode a, ExitCode b) {
  constexpr std::array kAscending{ExitCode::Success, ExitCode::Findings, ExitCode::Interrupted,
                                  ExitCode::Usage, ExitCode::Defect};
  return std::max(a, b, [&](ExitCode x, ExitCode y) {
    return std::ranges::find(kAscending, x) < std::ranges::find(kAscending, y);
  });
}

}  // namespace sdlc::cli
