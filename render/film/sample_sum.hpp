#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "render/math/color.hpp"

namespace sdlc::render {

/// Sums consecutive samples of one stream in an order that depends on their indices only:
/// sequentially within aligned blocks of 64, then as a binary tree over the blocks. Whole blocks
/// can therefore be traced anywhere in any order and give the same bits, and the rounding error is
/// that of pairwise summation.
///
/// A sum is stored as the fewest subtrees that cover its whole blocks, from left to right, and the
/// sum of its last block if that is incomplete. The storage is external, because a picture has
/// millions of such sums.
class SampleSum {
 public:
  static constexpr std::uint32_t kBlock = 64;

  /// The number of values of the sum of the samples [first, end).
  static constexpr std::size_t values_of(std::uint32_t first, std::uint32_t end) noexcept {
    return subtrees(first / kBlock, end / kBlock) + (end % kBlock != 0);
  }
  /// An upper limit for all values_of(first, e) with e ≤ end.
  static constexpr std::size_t max_values_of(std::uint32_t first, std::uint32_t end) noexcept {
    const std::uint32_t blocks = (end - first) / kBlock;
    return static_cast<std::size_t>((first == 0 ? 1 : 2) * std::bit_width(blocks)) + 1;
  }

  /// The samples [first, end), in a storage that has room for all that follow. `first` is a
  /// multiple of kBlock.
  SampleSum(std::span<LinearRgb> storage, std::uint32_t first, std::uint32_t end) noexcept
      : storage_(storage), first_(first), end_(end) {}

  std::uint32_t first() const noexcept { return first_; }
  std::uint32_t end() const noexcept { return end_; }
  /// The values, values_of(first, end) of them.
  std::span<const LinearRgb> values() const noexcept {
    return storage_.first(values_of(first_, end_));
  }

  /// The sum of the last block, which the next samples continue.
  LinearRgb open_block() const noexcept {
    return end_ % kBlock == 0 ? LinearRgb{} : storage_[closed()];
  }

  /// Adds `samples` samples to the last block, whose new sum is `block`.
  void extend(LinearRgb block, std::uint32_t samples) noexcept {
    const std::size_t last = closed();
    end_ += samples;
    storage_[last] = block;
    if (end_ % kBlock == 0) join_subtrees(last);
  }

  /// Adds the samples of `next`, which begin where these end, at the end of a block. The storage
  /// has room for max_values_of(first, next.end()).
  void append(const SampleSum& next) noexcept {
    std::size_t last = closed(), from = 0;
    for_each_subtree(next.first_ / kBlock, next.end_ / kBlock,
                     [&](std::uint32_t begin, std::uint32_t size) {
                       storage_[last] = next.storage_[from++];
                       // A right subtree joins the left one of its size.
                       const std::uint32_t first = first_ / kBlock;
                       for (; (begin & size) != 0 && begin - first >= size; size *= 2, --last) {
                         storage_[last - 1] += storage_[last];
                         begin -= size;
                       }
                       ++last;
                     });
    if (next.end_ % kBlock != 0) storage_[last] = next.storage_[from];
    end_ = next.end_;
  }

  LinearRgb total() const noexcept {
    std::size_t left = closed();
    LinearRgb sum = open_block();
    while (left > 0) sum = storage_[--left] + sum;
    return sum;
  }

 private:
  /// Visits the subtrees that cover the blocks [first, end), from left to right: the largest
  /// aligned ones.
  template <typename Visit>
  static constexpr void for_each_subtree(std::uint32_t first, std::uint32_t end, Visit visit) {
    while (first < end) {
      const std::uint32_t fitting = std::bit_floor(end - first);
      const std::uint32_t size = first == 0 ? fitting : std::min(fitting, first & -first);
      visit(first, size);
      first += size;
    }
  }
  /// The number of subtrees that cover the blocks [first, end).
  static constexpr std::size_t subtrees(std::uint32_t first, std::uint32_t end) noexcept {
    std::size_t count = 0;
    // Subtrees that end where a larger one begins.
    while (first != 0 && first + (first & -first) <= end && first < end) {
      first += first & -first;
      ++count;
    }
    return count + static_cast<std::size_t>(std::popcount(end - first));
  }
  std::size_t closed() const noexcept { return subtrees(first_ / kBlock, end_ / kBlock); }

  /// Joins the last block, storage_[last], with the complete subtrees to its left.
  void join_subtrees(std::size_t last) noexcept {
    const std::uint32_t first = first_ / kBlock, end = end_ / kBlock;
    for (std::uint32_t size = 2; end % size == 0 && end - first >= size; size *= 2, --last) {
      storage_[last - 1] += storage_[last];
    }
  }

  std::span<LinearRgb> storage_;
  std::uint32_t first_, end_;
};

}  // namespace sdlc::render
