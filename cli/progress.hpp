#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <ostream>
#include <string>
#include <thread>

#include "render/session/render.hpp"

namespace sdlc::cli {

enum class ProgressStyle : std::uint8_t { None, Line, Plain, Json };

/// Over all pixels, without a goal.
std::uint64_t total_samples(const render::RenderSettings& settings);

/// Reports the progress of a render, on its own thread, until it is destroyed. Line rewrites one
/// line of a terminal ten times per second; Plain adds a line every 10 seconds or 5 %, whichever is
/// later; Json an object per second.
class ProgressReporter {
 public:
  ProgressReporter(ProgressStyle style, const render::RenderMonitor& monitor,
                   const render::RenderSettings& settings, std::ostream& err);
  ~ProgressReporter();
  ProgressReporter(const ProgressReporter&) = delete;
  ProgressReporter& operator=(const ProgressReporter&) = delete;

 private:
  void run();
  void report(double seconds);

  ProgressStyle style_;
  const render::RenderMonitor& monitor_;
  bool has_goal_;  // and the number of samples is unknown
  double total_;
  std::ostream& err_;
  double next_fraction_ = 0.05;  // for Plain
  double next_seconds_ = 0;      // for Plain and Json
  bool has_line_ = false;

  std::mutex mutex_;
  std::condition_variable wake_;
  bool is_done_ = false;
  std::thread thread_;
};

}  // namespace sdlc::cli
