#include "cli/interrupt.hpp"

#include <csignal>

namespace sdlc::cli {
namespace {

std::atomic<std::atomic<bool>*> interrupted_flag{nullptr};
static_assert(std::atomic<std::atomic<bool>*>::is_always_lock_free, "a signal handler touches it");
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler touches it");

void on_signal(int signal) {
  if (std::atomic<bool>* flag = interrupted_flag.load()) flag->store(true);
  std::signal(signal, SIG_DFL);  // the next one ends the process
}

void install(void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  for (const int signal : {SIGINT, SIGTERM}) {
    struct sigaction before {};
    // Who started us with a signal ignored (nohup, a shell's background job) means it.
    if (sigaction(signal, nullptr, &before) == 0 && before.sa_handler == SIG_IGN) continue;
    sigaction(signal, &action, nullptr);
  }
}

}  // namespace

InterruptGuard::InterruptGuard(std::atomic<bool>& flag) {
  interrupted_flag.store(&flag);
  install(on_signal);
}

InterruptGuard::~InterruptGuard() {
  install(SIG_DFL);
  interrupted_flag.store(nullptr);
}

}  // namespace sdlc::cli
