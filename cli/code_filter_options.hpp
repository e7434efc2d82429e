#pragma once

#include "cli/command_line.hpp"
#include "lang/lint_config/code_filter.hpp"

namespace sdlc::cli {

/// --select and --ignore: comma-separated lists, which may be repeated. A code that matches no
/// diagnostic is rejected.
void add_code_filter(Command& command, lang::CodeFilter& filter);

}  // namespace sdlc::cli
