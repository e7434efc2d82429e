#pragma once

#include <filesystem>
#include <string>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/source/limits.hpp"
#include "lang/workspace/workspace.hpp"

namespace sdlc::test {

/// What an editor wants to know of a scene or config: the diagnostics of everything it reads, and
/// what the names in its files mean, as text that can be compared.
struct CheckedProgram {
  std::string diagnostics;
  std::string symbols;

  friend bool operator==(const CheckedProgram&, const CheckedProgram&) = default;
};

/// Parses, resolves, evaluates, lowers and lints. Throws lang::StopRequested if `stop` says so.
CheckedProgram check_program(lang::Workspace& workspace, const std::filesystem::path& root,
                             const lang::Limits& limits, const lang::StopRequest* stop = nullptr);

}  // namespace sdlc::test
