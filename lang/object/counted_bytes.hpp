#pragma once

#include <cstddef>

namespace sdlc::lang {

/// Counts bytes in a sum of the thread as long as this lives: those of strings, lists and whatever
/// else a scene can have any number of. The limit on memory is compared with the sum.
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
  /// The bytes of all that live.
  static std::size_t sum() noexcept { return sum_; }

 private:
  static inline thread_local constinit std::size_t sum_ = 0;
  std::size_t bytes_ = 0;
};

}  // namespace sdlc::lang
