#pragma once

#include <functional>

#include "cli/environment.hpp"
#include "cli/exit_code.hpp"
#include "cli/render_job.hpp"
#include "cli/render_options.hpp"
#include "cli/terminal/status_line.hpp"

namespace sdlc::cli {

/// Renders the scene of the options once, for as long as RenderRun::outdated is not requested.
using RenderOnce = std::function<ExitCode(RenderOptions&, RenderRun&, Environment&)>;

/// `render --watch`: calls `render` for each scene of the options, and again whenever a file that
/// it has read for the scene changes, until Ctrl-C. Failures of a render are reported. Throws
/// UsageError.
ExitCode render_and_watch(const RenderOptions& options, StatusLine& line, Environment& env,
                          const RenderOnce& render);

}  // namespace sdlc::cli
