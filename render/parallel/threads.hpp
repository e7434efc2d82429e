#pragma once

#include <exception>

namespace sdlc::render {

/// The number of worker threads if `asked` are requested; 0 requests all hardware threads. Fewer if
/// the system does not allow so many (`ulimit -u`, a container's limit), and at least 1. Reserves a
/// few auxiliary threads.
int thread_count(int asked);

/// The number of threads without the limits of the system.
int wanted_threads(int asked);

/// Whether the exception reports a thread that could not be started.
bool is_thread_shortage(const std::exception& error) noexcept;

}  // namespace sdlc::render
