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
#include <utility>
#include <vector>

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

namespace fs = std::filesystem;

/// Refuses what --watch would read or write only once.
void check_watch(const RenderOptions& options) {
  if (std::ranges::count(options.files, kStandardStream) > 0) {
    throw UsageError("--watch: standard input does not change; name a file");
  }
  if (std::ranges::count(options.outputs, kStandardStream) > 0) {
    throw UsageError("--watch: standard output holds only one picture; name a file");
  }
}

/// The scenes of a command, by their places in its arguments.
class WatchedScenes {
 public:
  explicit WatchedScenes(std::size_t count) : is_outdated_(count, true) {}

  /// Waits for changes, for at most this long. Returns the file that a scene has been outdated by.
  std::optional<fs::path> wait(std::chrono::milliseconds time) {
    std::optional<fs::path> changed;
    for (FileWatch::Change& change : watch_.wait(time)) {
      is_outdated_[change.reader] = true;
      changed = std::move(change.path);
    }
    return changed;
  }
  /// The next scene to render, which counts as rendered from now on.
  std::optional<std::size_t> take_outdated() {
    const auto found = std::ranges::find(is_outdated_, true);
    if (found == is_outdated_.end()) return std::nullopt;
    *found = false;
    return static_cast<std::size_t>(found - is_outdated_.begin());
  }
  bool is_outdated(std::size_t scene) const { return is_outdated_[scene]; }
  FileWatch& watch() noexcept { return watch_; }

 private:
  FileWatch watch_;
  std::vector<bool> is_outdated_;
};

/// Renders a scene, for as long as it is not outdated. Returns the file that has changed meanwhile.
std::optional<fs::path> render_watched(const RenderOptions& options, std::size_t scene,
                                       WatchedScenes& scenes, Environment& given_env,
                                       const RenderOnce& render) {
  constexpr std::chrono::milliseconds kBusy(20);
  const WatchedFiles files(scenes.watch(), scene);
  lang::Workspace workspace(files);
  Environment env = given_env.with_workspace(workspace);
  RenderOptions round = options;
  round.files = {options.files[scene]};
  RenderRun run;
  std::optional<fs::path> changed;
  {
    const std::jthread watcher([&](const std::stop_token& stop) {
      while (!stop.stop_requested()) {
        if (auto of_scenes = scenes.wait(kBusy)) changed = std::move(of_scenes);
        if (scenes.is_outdated(scene)) return run.outdated.request();
      }
    });
    report_failure(env, [&] { return render(round, run, env); });
  }
  return changed;
}

}  // namespace

ExitCode render_and_watch(const RenderOptions& options, StatusLine& line, Environment& env,
                          const RenderOnce& render) {
  constexpr std::chrono::milliseconds kIdle(200);
  check_watch(options);
  std::atomic<bool> interrupted{false};
  const InterruptGuard guard(interrupted);
  WatchedScenes scenes(options.files.size());
  const auto report = [&](const std::optional<fs::path>& changed) {
    if (!changed || options.is_quiet()) return;
    std::error_code ignored;
    const auto name = changed->lexically_proximate(fs::current_path(ignored));
    env.err << fmt::format("`{}` has changed\n", lang::printable(name.string())) << std::flush;
  };
  for (bool is_first = true; !interrupted; is_first = false) {
    while (const auto scene = interrupted ? std::nullopt : scenes.take_outdated()) {
      report(render_watched(options, *scene, scenes, env, render));
    }
    if (!interrupted && !options.is_quiet()) {
      const std::size_t files = scenes.watch().size();
      const std::string text = fmt::format(
          "watching {}; Ctrl-C ends", files == 1 ? "one file" : fmt::format("{} files", files));
      if (env.err_is_terminal) {
        line.show(text);
      } else if (is_first) {
        env.err << text << std::endl;
      }
    }
    std::optional<fs::path> changed;
    while (!interrupted && !changed) changed = scenes.wait(kIdle);
    report(changed);
  }
  return ExitCode::Interrupted;
}

}  // namespace sdlc::cli
