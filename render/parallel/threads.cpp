#include "render/parallel/threads.hpp"

#include <algorithm>
#include <mutex>
#include <system_error>
#include <thread>

#include "render/parallel/thread_probe.hpp"

namespace sdlc::render {
namespace {

/// How many of the wanted threads can run at the same time, including the calling thread.
int working_threads(int wanted) {
  constexpr int kOthers = kCodecThreads + 2;  // for reporting progress and loading the codec
  static std::mutex mutex;
  static int known = 1;
  static bool is_all = false;
  const std::lock_guard lock(mutex);
  if (wanted > known && !is_all) {
    const int tried = wanted - 1 + kOthers;
    const int started = startable_threads(tried);
    is_all = started < tried;
    known = std::max(known, started + 1 - kOthers);
  }
  return std::min(wanted, known);
}

}  // namespace

int wanted_threads(int asked) {
  constexpr int kMax = 1024;  // more would only cost memory
  const int machine = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  return std::min(asked > 0 ? asked : machine, kMax);
}

int thread_count(int asked) { return working_threads(wanted_threads(asked)); }

bool is_thread_shortage(const std::exception& error) noexcept {
  const auto* system = dynamic_cast<const std::system_error*>(&error);
  return system != nullptr && system->code() == std::errc::resource_unavailable_try_again;
}

}  // namespace sdlc::render
