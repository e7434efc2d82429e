#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "render/math/color.hpp"

namespace sdlc::render {

/// The sum of the samples of one pixel in an order that is fixed by their indices: one after
/// another inside aligned blocks of 64, then a binary tree over the blocks. Whoever computes whole
/// blocks, in whatever order, can join them to the same bits; and the rounding error stays that of
/// a pairwise sum.
class SampleSum {
 public:
  static constexpr std::uint64_t kBlock = 64;

  void add(LinearRgb sample) noexcept {
    block_ += sample;
    if (++count_ % kBlock == 0) close_block();
  }

  /// Adds the sum of the next `samples` samples; the last block may have fewer than kBlock of them,
  /// all others have exactly as many. Precondition: nothing was added one by one since a block.
  void add_block(LinearRgb sum, std::uint64_t samples) noexcept {
    block_ = sum;
    count_ += samples;
    if (samples == kBlock) close_block();
  }

  std::uint64_t count() const noexcept { return count_; }

  LinearRgb total() const noexcept {
    LinearRgb sum = block_;
    for (std::uint64_t blocks = count_ / kBlock, level = 0; blocks != 0; blocks >>= 1, ++level) {
      if (blocks & 1) sum = levels_[level] + sum;
    }
    return sum;
  }

 private:
  /// A binary counter: levels_[k] holds the sum of 2^k blocks while bit k of the number of blocks
  /// is set.
  void close_block() noexcept {
    const std::uint64_t blocks = count_ / kBlock;
    LinearRgb sum = block_;
    const auto carry = static_cast<std::size_t>(std::countr_zero(blocks));
    for (std::size_t level = 0; level < carry; ++level) sum = levels_[level] + sum;
    levels_[carry] = sum;
    block_ = LinearRgb{};
  }

  std::uint64_t count_ = 0;
  LinearRgb block_;
  std::array<LinearRgb, 58> levels_;  // 2^64 samples
};

}  // namespace sdlc::render
