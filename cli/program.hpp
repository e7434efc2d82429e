#pragma once

#include <span>
#include <string>

#include "cli/environment.hpp"
#include "cli/exit_code.hpp"

namespace sdlc::cli {

/// The whole program: parses the arguments (without the program's own name), runs the command and
/// returns its status. Errors are printed on env.err. Throws only if a thread could not be started
/// (render::is_thread_shortage): libraries cannot even shut down properly in that state.
ExitCode run_program(std::span<const std::string> arguments, Environment& env);

}  // namespace sdlc::cli
