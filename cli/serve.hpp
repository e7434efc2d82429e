#pragma once

#include "cli/environment.hpp"
#include "cli/exit_code.hpp"
#include "cli/serve_scene.hpp"

namespace sdlc::cli {

/// `sdlc serve`: shows the scene in browsers, and again whenever it changes, until Ctrl-C. The
/// address of the page is printed on standard output. Throws UsageError, render::IoError.
ExitCode serve(const ServeOptions& options, Environment& env);

}  // namespace sdlc::cli
