#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "render/math/color.hpp"

namespace sdlc::render {

/// The sum of the samples of one stream in an order that is fixed by their indices: one after
/// another inside aligned blocks of 64, then a binary tree over the blocks. Whoever computes whole
/// blocks, in whatever order, can join them to the same bits; and the rounding error stays that of
/// a pairwise sum. The numbers are kept elsewhere: a picture has millions of such sums.
class SampleSum {
 public:
  static constexpr std::uint32_t kBlock = 64;

  /// How many numbers the sum of so many samples is kept in.
  static constexpr std::size_t storage_for(std::uint64_t samples) noexcept {
    return 1 + static_cast<std::size_t>(std::bit_width(samples / kBlock));
  }

  /// The sum of the first `count` samples, in `storage`, which has room for all that are to come;
  /// all 0 for count 0.
  SampleSum(std::span<LinearRgb> storage, std::uint64_t count) noexcept
      : storage_(storage), count_(count) {}

  std::uint64_t count() const noexcept { return count_; }

  /// The sum of the last block so far, which the next samples go on with.
  LinearRgb open_block() const noexcept { return storage_[0]; }

  /// `samples` more of the last block, whose sum they make `block`.
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
  /// A binary counter: storage_[1 + k] holds the sum of 2^k blocks while bit k of the number of
  /// blocks is set.
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
