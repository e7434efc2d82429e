#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>

namespace sdlc::render {

/// Calls body(begin, end) for each range of `grain` (at least 1) consecutive indices below `count`,
/// the last one shorter, in any order, and returns when all calls have returned. The calls are made
/// by the calling thread and by those of its Workers; without Workers, by a thread per processor. A
/// body may call this function. After an exception no further ranges begin; one of them is
/// rethrown.
void parallel_ranges(std::size_t count, std::size_t grain,
                     const std::function<void(std::size_t begin, std::size_t end)>& body);

/// Calls body(i) for each i below `count`, as parallel_ranges(). `grain`: indices that are cheap
/// are worth distributing only together.
template <typename Body>
void parallel_for(std::size_t count, const Body& body, std::size_t grain = 1) {
  parallel_ranges(count, grain, [&body](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) body(i);
  });
}

}  // namespace sdlc::render
