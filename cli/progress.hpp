#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <ostream>
#include <string>
#include <thread>

#include "render/tiles/render.hpp"

namespace sdlc::cli {

enum class ProgressStyle : std::uint8_t { None, Line, Plain, Json };

/// Of all pixels, without a goal.
std::uint64_t total_samples(const render::RenderSettings& settings);

/// Tells how far a render is, from a thread of its own, until it is destroyed. Line rewrites one
/// line of a terminal ten times a second; Plain adds a line every 10 seconds or 5 %, whichever is
/// later; Json an object a second.
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
  bool has_goal_;  // and no number of samples that is known
  double total_;
  std::ostream& err_;
  double next_fraction_ = 0.05;  // of Plain
  double next_seconds_ = 0;      // of Plain and Json
  bool has_line_ = false;

  std::mutex mutex_;
  std::condition_variable wake_;
  bool is_done_ = false;
  std::thread thread_;
};

}  // namespace sdlc::cli
