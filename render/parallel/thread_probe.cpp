#include "render/parallel/thread_probe.hpp"

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <iterator>
#include <latch>
#include <system_error>
#include <thread>
#include <vector>

namespace sdlc::render {
namespace {

/// The number of threads of this process; 0 if unknown.
std::ptrdiff_t living_threads() {
  std::error_code error;
  std::filesystem::directory_iterator tasks("/proc/self/task", error);
  return error ? 0 : std::distance(begin(tasks), end(tasks));
}

/// The system still counts a joined thread for some microseconds.
void wait_for_threads(std::ptrdiff_t left) {
  constexpr int kPatience = 1000;
  for (int i = 0; i < kPatience && living_threads() > left; ++i) {
    std::this_thread::sleep_for(std::chrono::microseconds(100));
  }
}

}  // namespace

int startable_threads(int count) {
  const std::ptrdiff_t before = living_threads();
  std::latch end(1);
  std::vector<std::thread> threads;
  threads.reserve(static_cast<std::size_t>(count));
  try {
    while (static_cast<int>(threads.size()) < count) {
      threads.emplace_back([&end] { end.wait(); });
    }
  } catch (const std::system_error&) {  // the limit is reached
  }
  end.count_down();
  for (std::thread& thread : threads) thread.join();
  if (before > 0) wait_for_threads(before);
  return static_cast<int>(threads.size());
}

}  // namespace sdlc::render
