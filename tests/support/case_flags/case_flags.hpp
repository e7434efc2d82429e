#pragma once

#include "lang/program/program.hpp"
#include "lang/workspace/workspace.hpp"
#include "tests/support/file_test.hpp"

namespace sdlc::test {

/// Parses the flags of a case: `=== --set NAME ===` and `=== --limit NAME ===` with the value
/// below, and `=== --sandbox ===`. Throws std::runtime_error for any other flag.
lang::ProgramOptions program_options(const FileCase& file_case, lang::Workspace& workspace);

}  // namespace sdlc::test
