#include "render/film/sample_sum.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace sdlc::render {
namespace {

std::vector<double> values(std::size_t count) {
  std::vector<double> values;
  for (std::size_t i = 0; i < count; ++i)
    values.push_back(std::exp(10 * std::sin(static_cast<double>(i))));
  return values;
}

/// The sum by its definition: blocks of 64 sequentially; the blocks of the largest power of two
/// that fits form the left branch of a tree.
double defined_sum(const std::vector<double>& all, std::size_t begin, std::size_t end) {
  constexpr std::size_t kBlock = SampleSum::kBlock;
  const std::size_t blocks = (end - begin) / kBlock;
  if (blocks == 0 || end - begin == kBlock) {
    double sum = 0;
    for (std::size_t i = begin; i < end; ++i) sum += all[i];
    return sum;
  }
  std::size_t left = std::bit_floor(blocks) * kBlock;
  if (begin + left == end) left /= 2;
  return defined_sum(all, begin, begin + left) + defined_sum(all, begin + left, end);
}

/// The samples [first, end), one by one, in the storage that values_of() demands at each step.
std::vector<LinearRgb> summed(const std::vector<double>& all, std::uint32_t first,
                              std::uint32_t end) {
  std::vector<LinearRgb> storage;
  for (std::uint32_t i = first; i < end; ++i) {
    // While blocks are joined, the last one still needs its own value.
    storage.resize(SampleSum::values_of(first, i / SampleSum::kBlock * SampleSum::kBlock) + 1);
    SampleSum sum(storage, first, i);
    sum.extend(sum.open_block() + LinearRgb{all[i]}, 1);
    EXPECT_LE(storage.size(), SampleSum::max_values_of(first, end));
  }
  storage.resize(SampleSum::values_of(first, end));
  return storage;
}

TEST(SampleSum, IsTheTreeOverBlocks) {
  for (const std::uint32_t count : {0u, 1u, 63u, 64u, 65u, 128u, 1000u, 4096u, 12345u}) {
    const std::vector<double> all = values(count);
    std::vector<LinearRgb> storage = summed(all, 0, count);
    const SampleSum sum(storage, 0, count);
    EXPECT_EQ(sum.end(), count);
    EXPECT_EQ(sum.total().g, defined_sum(all, 0, count)) << count;
  }
}

TEST(SampleSum, NeedsNoMoreValuesThanSubtrees) {
  constexpr std::uint32_t kBlock = SampleSum::kBlock;
  EXPECT_EQ(SampleSum::values_of(0, 0), 0u);
  EXPECT_EQ(SampleSum::values_of(0, 8 * kBlock), 1u);
  EXPECT_EQ(SampleSum::values_of(0, 7 * kBlock + 1), 4u);
  EXPECT_EQ(SampleSum::values_of(3 * kBlock, 8 * kBlock), 2u);   // 3, 4 to 7
  EXPECT_EQ(SampleSum::values_of(3 * kBlock, 11 * kBlock), 4u);  // 3, 4 to 7, 8 and 9, 10
}

TEST(SampleSum, OfALaterBeginHoldsSubtreesOfTheWhole) {
  constexpr std::uint32_t kBlock = SampleSum::kBlock;
  const std::vector<double> all = values(20 * kBlock);
  for (std::uint32_t first = 0; first < 20; ++first) {
    for (std::uint32_t end = first; end <= 20; ++end) {
      const std::vector<LinearRgb> storage = summed(all, first * kBlock, end * kBlock);
      std::size_t i = 0;
      for (std::uint32_t begin = first; begin < end; ++i) {
        std::uint32_t size = 1;
        while (begin % (2 * size) == 0 && begin + 2 * size <= end) size *= 2;
        ASSERT_LT(i, storage.size());
        EXPECT_EQ(storage[i].g, defined_sum(all, begin * kBlock, (begin + size) * kBlock));
        begin += size;
      }
      EXPECT_EQ(i, storage.size());
    }
  }
}

}  // namespace
}  // namespace sdlc::render
