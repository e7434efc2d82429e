#include "render/session/adaptive_samples.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

namespace sdlc::render {
namespace {

constexpr int kWidth = 20;
constexpr std::size_t kPixels = 400;

/// 64 samples per pixel: the left half has 1/100 of the variance of the right one.
std::vector<PixelSpread> uneven_spreads() {
  std::vector<PixelSpread> spreads(kPixels);
  for (std::size_t i = 0; i < kPixels; ++i) {
    spreads[i].squared_error = i % kWidth < kWidth / 2 ? 1e-4 : 1e-2;
  }
  return spreads;
}

ErrorEstimate of_mean_one() {
  ErrorEstimate estimate;
  estimate.mean = 1;
  return estimate;
}

std::vector<std::uint32_t> samples_for(double error, const std::vector<PixelSpread>& spreads,
                                       std::uint64_t most = 1 << 20) {
  return adaptive_samples(spreads, of_mean_one(), kWidth, error, SamplerKind::Independent, 64,
                          most);
}

TEST(AdaptiveSamples, BringTheErrorDownToTheGoal) {
  const std::vector<PixelSpread> spreads = uneven_spreads();
  const double goal = 0.01;
  const std::vector<std::uint32_t> samples = samples_for(goal, spreads);
  double squares = 0;
  for (std::size_t i = 0; i < kPixels; ++i) {
    squares += spreads[i].squared_error * 64 / samples[i];
  }
  const double error = std::sqrt(squares / (3 * kPixels));
  // The variance of the left half is overestimated.
  EXPECT_LE(error, 1.02 * goal);
  EXPECT_GE(error, 0.9 * goal);
}

TEST(AdaptiveSamples, FollowTheRootOfTheVariance) {
  const std::vector<std::uint32_t> samples = samples_for(0.001, uneven_spreads());
  const double of_all = 0.1 * (1e-2 + 1e-4) / 2;
  const double expected = std::sqrt((0.9 * 1e-2 + of_all) / (0.9 * 1e-4 + of_all));
  EXPECT_NEAR(static_cast<double>(samples[15]) / samples[5], expected, 0.01);
}

TEST(AdaptiveSamples, AreWholeReplicatesFromThePilotUpToTheMost) {
  for (const std::uint32_t n : samples_for(0.001, uneven_spreads(), 2000)) {
    EXPECT_EQ(n % 4, 0u);
    EXPECT_GE(n, 64u);
    EXPECT_LE(n, 2000u);
  }
  for (const std::uint32_t n : samples_for(0.001, uneven_spreads(), 1001)) EXPECT_LE(n, 1001u);
  const std::vector<std::uint32_t> few = samples_for(0.5, uneven_spreads());
  EXPECT_EQ(*std::ranges::max_element(few), 64u);
}

// This keeps the estimate of the error, and the mean, unbiased.
TEST(AdaptiveSamples, OfAPixelDoNotDependOnItself) {
  std::vector<PixelSpread> spreads = uneven_spreads();
  const std::uint32_t before = samples_for(0.01, spreads)[215];
  spreads[215].squared_error = 0;
  const std::uint32_t after = samples_for(0.01, spreads)[215];
  // Except through the sum over all pixels, of which it is 1/200.
  EXPECT_NEAR(after, before, 4 + 0.02 * before);
  spreads[214].squared_error = 0;
  EXPECT_LT(samples_for(0.01, spreads)[215], after);
}

TEST(AdaptiveSamples, OfOnePixelAreThoseThatItTakes) {
  const std::vector<PixelSpread> one{{.squared_error = 3}};
  const std::vector<std::uint32_t> samples =
      adaptive_samples(one, of_mean_one(), 1, 0.1, SamplerKind::Independent, 64, 1 << 20);
  ASSERT_EQ(samples.size(), 1u);
  EXPECT_NEAR(samples[0], 6400, 4);
}

}  // namespace
}  // namespace sdlc::render
