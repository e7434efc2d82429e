#pragma once

#include <atomic>

namespace sdlc::cli {

/// Installs handlers for SIGINT, SIGTERM and SIGHUP that remove the temporary files before the
/// process ends. An ignored signal (nohup, a shell's background job) stays ignored.
void handle_signals();

/// During its lifetime, the first of these signals sets `flag` instead of ending the process; the
/// second ends it. Nested guards set the flags of both; they belong to one thread.
class InterruptGuard {
 public:
  explicit InterruptGuard(std::atomic<bool>& flag);
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

 private:
  friend struct SignalHandler;

  std::atomic<bool>& flag_;
  InterruptGuard* const outer_;
};

}  // namespace sdlc::cli
