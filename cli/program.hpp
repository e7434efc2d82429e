#pragma once

#include <span>
#include <string>

#include "cli/environment.hpp"
#include "cli/exit_code.hpp"

namespace sdlc::cli {

/// The whole program: parses the arguments (without the program's own name), runs the command they
/// name and says how it ended. What goes wrong is told on env.err. Throws only where a thread could
/// not be started (render::is_thread_shortage): libraries that meet this cannot even end in good
/// order.
ExitCode run_program(std::span<const std::string> arguments, Environment& env);

}  // namespace sdlc::cli
