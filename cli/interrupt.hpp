#pragma once

#include <atomic>

namespace sdlc::cli {

/// Makes SIGINT, SIGTERM and SIGHUP end the process only after its temporary files are removed. A
/// signal that is ignored (nohup, a shell's background job) stays so.
void handle_signals();

/// While it lives, the first of these signals sets `flag` instead of ending the process; the second
/// ends it. One inside another sets the flags of both; they live in one thread.
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
