#pragma once

#include <span>
#include <string>

#include "cli/environment.hpp"
#include "cli/exit_code.hpp"

namespace sdlc::cli {

/// The whole program: parses the arguments (without the program's own name), runs the command they
/// name and says how it ended. Never throws; what goes wrong is told on env.err.
ExitCode run_program(std::span<const std::string> arguments, Environment& env);

}  // namespace sdlc::cli
