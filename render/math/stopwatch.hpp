#pragma once

#include <chrono>

namespace sdlc::render {

/// The time since its construction.
class Stopwatch {
 public:
  using Clock = std::chrono::steady_clock;

  Clock::time_point start() const noexcept { return start_; }
  double seconds() const noexcept {
    return std::chrono::duration<double>(Clock::now() - start_).count();
  }

 private:
  Clock::time_point start_ = Clock::now();
};

}  // namespace sdlc::render
