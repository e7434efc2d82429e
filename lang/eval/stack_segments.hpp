#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <utility>

namespace sdlc::lang {

/// Continues the machine's stack on the heap where it is nearly used up, so that deep recursion
/// needs no more of it than the memory that the limits allow (docs/decisions/0024). Each thread has
/// its own. Code checks is_low() wherever it may recurse, and continues by run().
class StackSegments {
 public:
  /// Free bytes that is_low() leaves: enough for what is called without another check.
  static constexpr std::size_t kReserve = std::size_t{64} << 10;
  /// Enough to load a file: to parse it and to resolve its names.
  static constexpr std::size_t kFile = std::size_t{4} << 20;

  /// Whether to continue by run(). The first answer of a thread is true.
  static bool is_low() noexcept { return is_below(limit_); }
  /// Whether there are fewer than `bytes`.
  static bool has_less_than(std::size_t bytes) noexcept {
    return limit_ == kUnknown || is_below(limit_ + scaled(bytes));
  }

  /// Calls the function with at least `bytes` of stack: on a new segment, which counts as memory of
  /// values, unless the stack has them. Exceptions pass through. False if the system has no memory
  /// for the segment; the function is then not called.
  template <typename Function>
  [[nodiscard]] static bool run(Function&& function, std::size_t bytes = 0) {
    using Callable = std::remove_reference_t<Function>;
    return run([](void* f) { (*static_cast<Callable*>(f))(); }, &function, bytes);
  }

 private:
  class Segment;
  static constexpr std::uintptr_t kUnknown = std::numeric_limits<std::uintptr_t>::max();

  /// Frames of instrumented code are several times as large.
  static constexpr std::size_t scaled(std::size_t bytes) noexcept {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    return 4 * bytes;
#else
    return bytes;
#endif
  }
  static bool is_below(std::uintptr_t limit) noexcept {
    return reinterpret_cast<std::uintptr_t>(__builtin_frame_address(0)) < limit;
  }
  static bool run(void (*function)(void*), void* argument, std::size_t bytes);
  static std::uintptr_t limit_of_thread();
  static void enter();

  static inline thread_local constinit std::uintptr_t limit_ = kUnknown;
};

}  // namespace sdlc::lang
