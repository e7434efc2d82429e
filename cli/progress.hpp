#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <ostream>
#include <string>
#include <thread>

#include "cli/terminal/status_line.hpp"
#include "render/session/render.hpp"

namespace sdlc::cli {

enum class ProgressStyle : std::uint8_t { None, Line, Plain, Json, OpenJd };

/// Over all pixels, without a goal.
std::uint64_t total_samples(const render::RenderSettings& settings);

/// When progress was and will be reported, over all that a command renders.
struct ProgressSchedule {
  std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
  double next_fraction = 0.05;  ///< for Plain
  double next_seconds = 1;      ///< since the start, for Plain, Json and OpenJd
  double next_line = 0;         ///< the same for Line
  StatusLine* line = nullptr;   ///< for Line
};

/// The place of a render among all that a command renders.
struct ProgressPart {
  double before = 0;                       ///< the share of all work that is done before it
  double share = 1;                        ///< its own share
  std::string label{};                     ///< such as "frame 3 of 24"; empty if it is the only one
  std::optional<std::uint64_t> samples{};  ///< to trace, if not total_samples()
  std::shared_ptr<ProgressSchedule> schedule = std::make_shared<ProgressSchedule>();
};

/// Reports the progress of a render, on its own thread, until it is destroyed; that of renders
/// which follow each other fast, in the end. Line rewrites one line of a terminal ten times per
/// second, which remains until there is other output; Plain adds a line every 10 seconds or 5 %,
/// whichever is later; Json an object per second; OpenJd the messages of Open Job Description every
/// 5 seconds.
class ProgressReporter {
 public:
  ProgressReporter(ProgressStyle style, const render::RenderMonitor& monitor,
                   const render::RenderSettings& settings, std::ostream& out,
                   ProgressPart part = {});
  ~ProgressReporter();
  ProgressReporter(const ProgressReporter&) = delete;
  ProgressReporter& operator=(const ProgressReporter&) = delete;

 private:
  void run();
  void report();

  ProgressStyle style_;
  const render::RenderMonitor& monitor_;
  bool has_goal_;  // and the number of samples is unknown
  double total_;
  std::ostream& out_;
  ProgressPart part_;
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();

  std::mutex mutex_;
  std::condition_variable wake_;
  bool is_done_ = false;
  std::thread thread_;
};

}  // namespace sdlc::cli
