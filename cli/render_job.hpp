#pragma once

#include <atomic>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>

#include "cli/environment.hpp"
#include "cli/exit_code.hpp"
#include "cli/interrupt.hpp"
#include "cli/outputs.hpp"
#include "cli/progress.hpp"
#include "cli/render_options.hpp"
#include "cli/terminal/preview.hpp"
#include "render/math/clock.hpp"

namespace sdlc::cli {

/// What the scenes of one command share.
struct RenderRun {
  std::size_t files = 1, files_before = 0;
  OutputSet outputs;
  std::string stats;  ///< of the pictures so far, one per line
  bool is_stats_file_behind = false;
  render::Clock::time_point stats_written{};
  bool has_stats_file = false;
  std::shared_ptr<ProgressSchedule> schedule = std::make_shared<ProgressSchedule>();
  std::atomic<bool> interrupted{false};
  std::optional<InterruptGuard> guard;
  Preview* preview = nullptr;  ///< null without --preview
  /// --watch: the scene has changed, and nothing of it is written.
  Cancellation outdated;

  /// Whether no further picture is begun.
  bool ends() const noexcept { return interrupted.load() || outdated.is_requested(); }
};

/// Writes RenderRun::stats to the file of --stats, if it is one. Throws IoError.
void write_stats_so_far(const RenderOptions& options, RenderRun& run, Environment& env);

/// Renders the pictures of RenderOptions::scene: one, or one for each frame. Throws what
/// report_failure() reports if nothing can be rendered.
ExitCode render_scene(const RenderOptions& options, RenderRun& run, Environment& env);

}  // namespace sdlc::cli
