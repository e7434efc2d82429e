#pragma once

#include <atomic>

namespace sdlc::cli {

/// While it lives, the first Ctrl-C (or SIGTERM) sets a flag instead of ending the process; the
/// second ends it. One at a time.
class InterruptGuard {
 public:
  explicit InterruptGuard(std::atomic<bool>& flag);
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;
};

}  // namespace sdlc::cli
