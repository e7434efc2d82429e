#pragma once

#include <exception>
#include <memory>

#include <tbb/global_control.h>

namespace sdlc::render {

/// How many threads work where `asked` are asked for; 0 asks for all of the machine. Fewer where
/// the system does not let so many start (`ulimit -u`, a container's limit), and at least 1. Leaves
/// room for the few threads beside them.
int thread_count(int asked);

/// How many would, if the system let them all start.
int wanted_threads(int asked);

/// Has oneTBB start no threads that cannot be started, wherever it is used while this lives: it
/// ends the process where one cannot.
class ThreadLimit {
 public:
  ThreadLimit();

 private:
  std::unique_ptr<tbb::global_control> limit_;  // null: there are enough
};

/// Whether the exception is of a thread that could not be started.
bool is_thread_shortage(const std::exception& error) noexcept;

}  // namespace sdlc::render
