#include "cli/interrupt.hpp"

#include <array>
#include <csignal>
#include <thread>

#include "render/image/atomic_file.hpp"

namespace sdlc::cli {
namespace {

std::atomic<InterruptGuard*> innermost{nullptr};
std::atomic<int> handlers{0};  // running handlers, on any thread
std::array<std::atomic<pid_t>, 16> children{};
static_assert(std::atomic<pid_t>::is_always_lock_free, "a signal handler reads it");
static_assert(std::atomic<int>::is_always_lock_free, "a signal handler writes it");
static_assert(std::atomic<InterruptGuard*>::is_always_lock_free, "a signal handler reads it");
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler writes it");

}  // namespace

struct SignalHandler {
  static void on_signal(int signal) {
    handlers.fetch_add(1);
    bool is_first = false;
    for (InterruptGuard* guard = innermost.load(); guard != nullptr; guard = guard->outer_) {
      is_first = !guard->flag_.exchange(true);  // the outermost guard decides
    }
    handlers.fetch_sub(1);
    if (is_first) return;
    for (const std::atomic<pid_t>& child : children) {
      if (const pid_t process = child.load()) ::kill(process, SIGKILL);
    }
    render::remove_unfinished_files();
    std::signal(signal, SIG_DFL);
    std::raise(signal);  // delivered when this returns
  }
};

void handle_signals() {
  struct sigaction action {};
  action.sa_handler = SignalHandler::on_signal;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction before {};
    if (sigaction(signal, nullptr, &before) == 0 && before.sa_handler == SIG_IGN) continue;
    sigaction(signal, &action, nullptr);
  }
}

InterruptGuard::InterruptGuard(std::atomic<bool>& flag) : flag_(flag), outer_(innermost.load()) {
  innermost.store(this);
  // A signal just before set only the outer flag.
  if (outer_ != nullptr && outer_->flag_.load()) flag_.store(true);
}

InterruptGuard::~InterruptGuard() {
  innermost.store(outer_);
  while (handlers.load() > 0) std::this_thread::yield();  // a handler may use this guard
}

void Cancellation::request() {
  const std::lock_guard lock(mutex_);
  is_requested_ = true;
  if (flag_ != nullptr) *flag_ = true;
}

Cancellation::Scope::Scope(Cancellation& cancellation, std::atomic<bool>& flag)
    : cancellation_(cancellation) {
  const std::lock_guard lock(cancellation.mutex_);
  cancellation.flag_ = &flag;
  if (cancellation.is_requested()) flag = true;
}

Cancellation::Scope::~Scope() {
  const std::lock_guard lock(cancellation_.mutex_);
  cancellation_.flag_ = nullptr;
}

KilledBySignals::KilledBySignals(pid_t process) noexcept {
  for (std::atomic<pid_t>& child : children) {
    pid_t none = 0;
    if (!child.compare_exchange_strong(none, process)) continue;
    slot_ = &child;
    return;
  }
}

KilledBySignals::~KilledBySignals() {
  if (slot_ != nullptr) slot_->store(0);
}

}  // namespace sdlc::cli
