#include "render/film/first_hits.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace sdlc::render {
namespace {

std::vector<FirstHit> random_hits(int count, double largest_depth) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<FirstHit> hits;
  for (int i = 0; i < count; ++i) {
    const Vec3 normal{uniform(random), uniform(random), uniform(random)};
    const double color = std::fabs(uniform(random));
    hits.push_back({.normal = normal / length(normal),
                    .depth = largest_depth * std::fabs(uniform(random)),
                    .albedo = {color, color / 2, 1 - color}});
  }
  return hits;
}

FirstHit at_depth(double depth) { return {.normal = {0, 0, 1}, .depth = depth, .albedo = {}}; }

bool have_equal_bytes(const FirstHitSums& a, const FirstHitSums& b) {
  return std::memcmp(&a, &b, sizeof(FirstHitSums)) == 0;
}

TEST(FirstHitSums, HaveTheSameBytesInEveryOrder) {
  for (const double depth : {1.0, 0x1p40, 0x1p63, 0x1p94}) {
    std::vector<FirstHit> hits = random_hits(1000, depth);
    FirstHitSums expected;
    for (const FirstHit& hit : hits) expected.add(hit);
    std::mt19937_64 random(9);
    for (int round = 0; round < 5; ++round) {
      std::shuffle(hits.begin(), hits.end(), random);
      FirstHitSums left, right;
      for (std::size_t i = 0; i < hits.size(); ++i) (i < 300 ? left : right).add(hits[i]);
      right += left;
      ASSERT_TRUE(have_equal_bytes(right, expected)) << depth;
    }
  }
}

TEST(FirstHitSums, CarryDepthsAcrossTheirLowerHalf) {
  FirstHitSums sums;
  for (int i = 1; i <= 1000; ++i) {
    sums.add(at_depth(0x1p64 - 0x1p11 * i));
  }
  EXPECT_DOUBLE_EQ(sums.mean_depth(), 0x1p64 - 0x1p11 * 500.5);
}

TEST(FirstHitSums, GiveMeans) {
  FirstHitSums sums;
  sums.add({.normal = {0, 0, 1}, .depth = 3, .albedo = {1, 0.5, 0.25}});
  sums.add({.normal = {0, 1, 0}, .depth = 6, .albedo = {0, 0.5, 7}});
  EXPECT_EQ(sums.hits(), 2u);
  EXPECT_EQ(sums.mean_normal(4), (Vec3{0, 0.25, 0.25}));
  EXPECT_EQ(sums.mean_albedo(4), (LinearRgb{0.25, 0.25, 0.3125})) << "7 counts as 1";
  EXPECT_EQ(sums.mean_depth(), 4.5) << "of the rays that hit";
}

TEST(FirstHitSums, CountDepthsThatAreNotAboveZeroAsZero) {
  FirstHitSums sums;
  sums.add(at_depth(-3));
  sums.add(at_depth(std::numeric_limits<double>::quiet_NaN()));
  sums.add(at_depth(6));
  EXPECT_EQ(sums.mean_depth(), 2);
}

}  // namespace
}  // namespace sdlc::render
