#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "render/math/color.hpp"

namespace sdlc::render {

/// Sums the samples of one stream in an order that depends on their indices only: sequentially
/// within aligned blocks of 64, then as a binary tree over the blocks. Whole blocks can therefore
/// be computed anywhere in any order and give the same bits, and the rounding error is that of
/// pairwise summation. The storage is external, because a picture has millions of such sums.
class SampleSum {
 public:
  static constexpr std::uint32_t kBlock = 64;

  /// The number of values that the sum of this many samples needs.
  static constexpr std::size_t storage_for(std::uint64_t samples) noexcept {
    return 1 + static_cast<std::size_t>(std::bit_width(samples / kBlock));
  }

  /// The sum of the first `count` samples, in `storage`, which must have room for all future ones;
  /// all 0 if count is 0.
  SampleSum(std::span<LinearRgb> storage, std::uint64_t count) noexcept
      : storage_(storage), count_(count) {}

  std::uint64_t count() const noexcept { return count_; }

  /// The partial sum of the last block, which the next samples continue.
  LinearRgb open_block() const noexcept { return storage_[0]; }

  /// Adds `samples` samples to the last block, whose new sum is `block`.
  void extend(LinearRgb block, std::uint32_t samples) noexcept {
    storage_[0] = block;
    count_ += samples;
    if (count_ % kBlock == 0) close_block();
  }

  LinearRgb total() const noexcept {
    LinearRgb sum = storage_[0];
    for (std::uint64_t blocks = count_ / kBlock, level = 1; blocks != 0; blocks >>= 1, ++level) {
      if (blocks & 1) sum = storage_[level] + sum;
    }
    return sum;
  }

 private:
  /// A binary counter: storage_[1 + k] holds the sum of 2^k blocks if bit k of the number of blocks
  /// is set.
  void close_block() noexcept {
    const std::uint64_t blocks = count_ / kBlock;
    LinearRgb sum = storage_[0];
    const auto carry = static_cast<std::size_t>(std::countr_zero(blocks));
    for (std::size_t level = 1; level <= carry; ++level) sum = storage_[level] + sum;
    storage_[1 + carry] = sum;
    storage_[0] = LinearRgb{};
  }

  std::span<LinearRgb> storage_;
  std::uint64_t count_ = 0;
};

}  // namespace sdlc::render
