#pragma once

#include <functional>

namespace sdlc::cli {

/// Calls the function where the stack is large enough for all that files may nest: on a thread of
/// its own where that of the process is smaller. Threads that start later have as much. False, with
/// nothing done, where there is no such stack.
[[nodiscard]] bool run_on_large_stack(std::function<void()> function);

}  // namespace sdlc::cli
