#pragma once

#include "lang/program/program.hpp"
#include "lang/source/source.hpp"
#include "tests/support/file_test.hpp"

namespace sdlc::test {

/// What the flags of a case say: `=== --set NAME ===` and `=== --limit NAME ===` with the value
/// below, and `=== --sandbox ===`. Throws std::runtime_error on any other flag.
lang::ProgramOptions program_options(const FileCase& file_case, const lang::FileSystem& files);

}  // namespace sdlc::test
