#pragma once

#include <cstddef>

namespace sdlc::lang {

/// Adds bytes to a sum per thread for its own lifetime: memory of strings, lists and everything
/// else whose number a scene does not bound. Limits::memory applies to the sum.
class CountedBytes {
 public:
  CountedBytes() = default;
  explicit CountedBytes(std::size_t bytes) noexcept { set(bytes); }
  CountedBytes(const CountedBytes&) = delete;
  CountedBytes& operator=(const CountedBytes&) = delete;
  ~CountedBytes() { set(0); }

  void set(std::size_t bytes) noexcept {
    sum_ += bytes - bytes_;  // modulo 2^64
    bytes_ = bytes;
  }
  /// The bytes of all live objects of this thread.
  static std::size_t sum() noexcept { return sum_; }

 private:
  static inline thread_local constinit std::size_t sum_ = 0;
  std::size_t bytes_ = 0;
};

}  // namespace sdlc::lang
