#include "render/parallel/workers.hpp"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <ranges>
#include <stop_token>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "render/parallel/parallel_for.hpp"
#include "render/parallel/threads.hpp"

namespace sdlc::render {
namespace {

using Body = std::function<void(std::size_t, std::size_t)>;

/// A loop in progress; it lives on the stack of the thread that called parallel_ranges().
class Loop {
 public:
  Loop(std::size_t count, std::size_t grain, const Body& body)
      : count_(count), grain_(grain), body_(body), outer_(current) {}

  bool has_more() const noexcept { return next_.load(std::memory_order_relaxed) < count_; }

  /// Whether the loop was begun by a call of the body of `other`, at any depth.
  bool is_inside(const Loop& other) const noexcept {
    const Loop* loop = outer_;
    while (loop != nullptr && loop != &other) loop = loop->outer_;
    return loop != nullptr;
  }

  /// Takes ranges until none is left. Returns the exception of a call.
  std::exception_ptr work() noexcept {
    const Current is_current(this);
    try {
      while (true) {
        const std::size_t begin = next_.fetch_add(grain_, std::memory_order_relaxed);
        if (begin >= count_) return nullptr;
        body_(begin, std::min(count_, begin + grain_));
      }
    } catch (...) {
      next_.store(count_, std::memory_order_relaxed);
      return std::current_exception();
    }
  }

  // Guarded by the mutex of the pool.
  int helpers = 0;
  std::exception_ptr failure;

 private:
  /// Whose body the thread is calling.
  static thread_local const Loop* current;

  class Current {
   public:
    explicit Current(const Loop* loop) noexcept : before_(std::exchange(current, loop)) {}
    ~Current() { current = before_; }
    Current(const Current&) = delete;
    Current& operator=(const Current&) = delete;

   private:
    const Loop* before_;
  };

  const std::size_t count_, grain_;
  const Body& body_;
  const Loop* const outer_;
  std::atomic<std::size_t> next_{0};
};

thread_local const Loop* Loop::current = nullptr;

thread_local Pool* used_pool = nullptr;

}  // namespace

/// Threads that help with loops. The caller of a loop works on it as well; a thread without ranges
/// left takes those of the loop that started last, which is most often the innermost one.
class Pool {
 public:
  explicit Pool(int threads) : threads_(threads) {}
  ~Pool() {
    // Together: each one that stops wakes all.
    for (std::jthread& helper : helpers_) helper.request_stop();
  }
  Pool(const Pool&) = delete;
  Pool& operator=(const Pool&) = delete;

  int threads() const noexcept { return threads_; }

  void run(std::size_t count, std::size_t grain, const Body& body) {
    Loop loop(count, grain, body);
    std::unique_lock lock(mutex_);
    if (helpers_.empty()) start_helpers();
    loops_.push_back(&loop);
    lock.unlock();
    changed_.notify_all();
    const std::exception_ptr failure = loop.work();
    lock.lock();
    std::erase(loops_, &loop);  // from now on nobody joins it
    note(failure, loop);
    // Its helpers may wait for ranges of loops inside it, so help them. Others could keep this
    // thread for longer than its own loop takes.
    while (loop.helpers > 0) {
      if (Loop* inner = last_loop_inside(&loop)) {
        help(*inner, lock);
      } else {
        changed_.wait(lock);
      }
    }
    if (loop.failure) std::rethrow_exception(loop.failure);
  }

 private:
  /// With the first loop: where there is none, threads would cost time for nothing.
  void start_helpers() {
    try {
      while (static_cast<int>(helpers_.size()) < threads_ - 1) {
        helpers_.emplace_back([this](const std::stop_token& stop) { serve(stop); });
      }
    } catch (const std::system_error&) {  // as many as the system allows
    }
  }

  void serve(const std::stop_token& stop) {
    used_pool = this;
    std::unique_lock lock(mutex_);
    // Ranges are taken without the lock: a loop that was found has ranges left only now.
    Loop* loop = nullptr;
    const auto finds_one = [&] { return (loop = last_loop_inside(nullptr)) != nullptr; };
    while (changed_.wait(lock, stop, finds_one)) help(*loop, lock);
  }

  /// The last started loop that has ranges left, of all or of those inside `outer`.
  Loop* last_loop_inside(const Loop* outer) const noexcept {
    for (Loop* loop : loops_ | std::views::reverse) {
      if (loop->has_more() && (outer == nullptr || loop->is_inside(*outer))) return loop;
    }
    return nullptr;
  }

  void help(Loop& loop, std::unique_lock<std::mutex>& lock) {
    ++loop.helpers;
    lock.unlock();
    const std::exception_ptr failure = loop.work();
    lock.lock();
    note(failure, loop);
    if (--loop.helpers == 0) changed_.notify_all();
  }

  static void note(const std::exception_ptr& failure, Loop& loop) noexcept {
    if (failure && !loop.failure) loop.failure = failure;
  }

  const int threads_;
  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::vector<Loop*> loops_;
  std::vector<std::jthread> helpers_;  // last: they end before what they use
};

Workers::Workers(int threads) : pool_(std::make_unique<Pool>(thread_count(threads))) {}
Workers::~Workers() = default;

int Workers::count() const noexcept { return pool_->threads(); }

Workers::InUse::InUse(Pool* pool) noexcept : before_(std::exchange(used_pool, pool)) {}
Workers::InUse::~InUse() { used_pool = before_; }

void parallel_ranges(std::size_t count, std::size_t grain, const Body& body) {
  if (count <= grain) {
    if (count > 0) body(0, count);
    return;
  }
  if (used_pool != nullptr) {
    used_pool->run(count, grain, body);
  } else {
    // Not kept: the threads of a render come out of the same number.
    Workers(0).run([&] { parallel_ranges(count, grain, body); });
  }
}

}  // namespace sdlc::render
