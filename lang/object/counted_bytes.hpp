#pragma once

#include <cstddef>

namespace sdlc::lang {

/// Bytes that something takes as long as this lives, in the sum of its thread: strings, lists and
/// whatever else a scene can have any number of. It is what the limit on memory is held against.
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
  /// Of all that live.
  static std::size_t sum() noexcept { return sum_; }

 private:
  static inline thread_local constinit std::size_t sum_ = 0;
  std::size_t bytes_ = 0;
};

}  // namespace sdlc::lang
