#pragma once

#include <functional>

namespace sdlc::cli {

/// Runs the function with a stack that is large enough for the max nesting of files: on a new
/// thread if that of the process is smaller. Threads started later have the same size. Returns
/// false, without running it, if no such stack is available.
[[nodiscard]] bool run_on_large_stack(std::function<void()> function);

}  // namespace sdlc::cli
