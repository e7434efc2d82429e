#pragma once

#include <atomic>
#include <mutex>

#include <sys/types.h>

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

/// Ends the renders of a command from another thread.
class Cancellation {
 public:
  /// Ends the render under way, and those that follow.
  void request();
  bool is_requested() const noexcept { return is_requested_.load(); }

  /// A render under way: `flag` is set when its end is requested.
  class Scope {
   public:
    Scope(Cancellation& cancellation, std::atomic<bool>& flag);
    ~Scope();
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

   private:
    Cancellation& cancellation_;
  };

 private:
  std::mutex mutex_;
  std::atomic<bool> is_requested_{false};
  std::atomic<bool>* flag_ = nullptr;
};

/// A child process that a signal kills with this process, during its lifetime; if there is a free
/// slot.
class KilledBySignals {
 public:
  explicit KilledBySignals(pid_t process) noexcept;
  ~KilledBySignals();
  KilledBySignals(const KilledBySignals&) = delete;
  KilledBySignals& operator=(const KilledBySignals&) = delete;

 private:
  std::atomic<pid_t>* slot_ = nullptr;
};

}  // namespace sdlc::cli
