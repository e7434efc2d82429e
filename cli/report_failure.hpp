#pragma once

#include <exception>
#include <functional>

#include "cli/environment.hpp"
#include "cli/exit_code.hpp"
#include "render/image/io_error.hpp"

namespace sdlc::cli {

/// TryAgain if the disk was full.
ExitCode exit_code_of(const render::IoError& error) noexcept;

/// Prints the failure as a warning.
void warn(const std::exception& failure, Environment& env);

/// Returns the status of `run`. Exceptions become messages on env.err, except if a thread could not
/// be started (render::is_thread_shortage).
ExitCode report_failure(Environment& env, const std::function<ExitCode()>& run);

}  // namespace sdlc::cli
