#pragma once

#include <cstddef>

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>
#include <tbb/task_arena.h>

#include "render/parallel/threads.hpp"

namespace sdlc::render {

/// The threads of one render.
class Workers {
 public:
  /// `threads` as in RenderSettings.
  explicit Workers(int threads)
      : count_(thread_count(threads)),
        limit_(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(count_)),
        arena_(count_) {
    // Start all threads, which also makes oneTBB load its allocator, before anything else loads a
    // library and before time is measured.
    arena_.execute([this] {
      tbb::parallel_for(
          0, count_, [](int) {}, tbb::simple_partitioner{});
    });
  }

  int count() const noexcept { return count_; }

  /// Calls `work`, whose parallel loops use these threads.
  template <typename Work>
  decltype(auto) run(const Work& work) {
    return arena_.execute(work);
  }

 private:
  int count_;
  tbb::global_control limit_;
  tbb::task_arena arena_;
};

}  // namespace sdlc::render
