#include "cli/render_watch.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <optional>
#include <stop_token>
#include <string>
#include <system_error>
#include <thread>

#include <fmt/format.h>

#include "cli/file_watch.hpp"
#include "cli/interrupt.hpp"
#include "cli/outputs.hpp"
#include "cli/report_failure.hpp"
#include "cli/usage_error.hpp"
#include "lang/text/display_width.hpp"
#include "lang/workspace/workspace.hpp"

namespace sdlc::cli {
namespace {

/// Refuses what --watch would read or write only once.
void check_watch(const RenderOptions& options) {
  if (std::ranges::count(options.files, kStandardStream) > 0) {
    throw UsageError("--watch: standard input does not change; name a file");
  }
  if (std::ranges::count(options.outputs, kStandardStream) > 0) {
    throw UsageError("--watch: standard output holds only one picture; name a file");
  }
}

}  // namespace

ExitCode render_and_watch(const RenderOptions& options, StatusLine& line, Environment& given_env,
                          const RenderOnce& render) {
  constexpr std::chrono::milliseconds kBusy(20), kIdle(200);
  check_watch(options);
  std::atomic<bool> interrupted{false};
  const InterruptGuard guard(interrupted);
  bool is_first = true;
  for (;;) {
    FileWatch watch;
    const WatchedFiles files(watch);
    lang::Workspace workspace(files);
    Environment env = given_env.with_workspace(workspace);
    RenderOptions round = options;
    RenderRun run;
    std::optional<std::filesystem::path> changed;
    {
      const std::jthread watcher([&](const std::stop_token& stop) {
        while (!stop.stop_requested() && !changed) changed = watch.wait(kBusy);
        if (changed) run.outdated.request();
      });
      report_failure(env, [&] { return render(round, run, env); });
    }
    if (!interrupted && !changed && !options.is_quiet()) {
      const std::string text =
          fmt::format("watching {}; Ctrl-C ends",
                      watch.size() == 1 ? "one file" : fmt::format("{} files", watch.size()));
      if (env.err_is_terminal) {
        line.show(text);
      } else if (is_first) {
        env.err << text << std::endl;
      }
    }
    is_first = false;
    while (!interrupted && !changed) changed = watch.wait(kIdle);
    if (interrupted) return ExitCode::Interrupted;
    if (options.is_quiet()) continue;
    std::error_code ignored;
    const auto name = changed->lexically_proximate(std::filesystem::current_path(ignored));
    env.err << fmt::format("`{}` has changed\n", lang::printable(name.string())) << std::flush;
  }
}

}  // namespace sdlc::cli
