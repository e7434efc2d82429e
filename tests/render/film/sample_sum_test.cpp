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

TEST(SampleSum, IsTheTreeOverBlocks) {
  for (const std::size_t count : {0u, 1u, 63u, 64u, 65u, 128u, 1000u, 4096u, 12345u}) {
    const std::vector<double> all = values(count);
    std::vector<LinearRgb> storage(SampleSum::storage_for(count));
    SampleSum sum(storage, 0);
    for (const double value : all) sum.extend(sum.open_block() + LinearRgb{value}, 1);
    EXPECT_EQ(sum.count(), count);
    EXPECT_EQ(sum.total().g, defined_sum(all, 0, count)) << count;
  }
}

}  // namespace
}  // namespace sdlc::render
