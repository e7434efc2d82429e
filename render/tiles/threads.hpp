#pragma once

#include <algorithm>
#include <thread>

namespace sdlc::render {

/// How many threads work where `asked` are asked for; 0 asks for all of the machine.
inline int thread_count(int asked) {
  constexpr int kMost = 1024;  // more only cost memory
  const int machine = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  return std::min(asked > 0 ? asked : machine, kMost);
}

}  // namespace sdlc::render
