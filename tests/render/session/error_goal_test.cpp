#include "render/session/error_goal.hpp"

#include <cmath>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

namespace sdlc::render {
namespace {

/// An error that falls as a power of the samples, known to 2 %.
ErrorEstimate error_of(double samples, double of_one, double slope) {
  ErrorEstimate estimate;
  estimate.relative_error = of_one * std::pow(samples, slope);
  estimate.interval = {0.98 * estimate.relative_error, 1.02 * estimate.relative_error};
  return estimate;
}

/// The samples of all passes.
std::vector<std::uint64_t> passes(ErrorGoal& goal, double of_one, double slope) {
  std::vector<std::uint64_t> all;
  std::optional<std::uint64_t> samples = goal.first_samples();
  while (samples) {
    all.push_back(*samples);
    const auto n = static_cast<double>(*samples);
    samples = goal.next_samples(*samples, error_of(n, of_one, slope));
  }
  return all;
}

TEST(ErrorGoal, IsReachedWithHardlyMoreSamplesThanItTakes) {
  for (const double slope : {-0.5, -0.57, -0.75}) {
    for (const double error : {0.1, 0.01, 0.003}) {
      ErrorGoal goal(error, 1 << 24);
      const std::vector<std::uint64_t> all = passes(goal, 1, slope);
      EXPECT_TRUE(goal.is_reached());
      const double needed = std::pow(error / 1.02, 1 / slope);
      const auto first = static_cast<double>(goal.first_samples());
      EXPECT_GE(static_cast<double>(all.back()), std::min(needed, first));
      EXPECT_LE(static_cast<double>(all.back()), std::max(first, 1.1 * needed + 4))
          << error << ", slope " << slope;
    }
  }
}

TEST(ErrorGoal, FallsWithAPowerOfTheSamples) {
  EXPECT_NEAR(min_error(0.08, 16), 0.01, 1e-12);
  EXPECT_NEAR(usual_growth(0.5), 3.374, 1e-3);
  EXPECT_EQ(usual_growth(1), 1);
}

TEST(ErrorGoal, AddsAQuarterAtMostInWholeReplicates) {
  ErrorGoal goal(1e-3, 1 << 24);
  const std::vector<std::uint64_t> all = passes(goal, 1, -0.5);
  ASSERT_GT(all.size(), 20u);
  for (std::size_t i = 1; i < all.size(); ++i) {
    EXPECT_GT(all[i], all[i - 1]);
    EXPECT_LE(all[i], all[i - 1] + std::max<std::uint64_t>(4, all[i - 1] / 4 + 3));
    EXPECT_EQ(all[i] % 4, 0u);
  }
}

TEST(ErrorGoal, EndsWithTheMostSamples) {
  for (const std::uint64_t most : {1u, 7u, 16u, 99u}) {
    ErrorGoal goal(1e-9, most);
    EXPECT_EQ(passes(goal, 1, -0.5).back(), most);
    EXPECT_FALSE(goal.is_reached());
  }
}

TEST(ErrorGoal, IsReachedByTheUpperEndOfTheInterval) {
  ErrorGoal goal(0.1, 1 << 24);
  ErrorEstimate estimate;
  estimate.relative_error = 0.099;
  estimate.interval = {0.097, 0.1001};
  EXPECT_TRUE(goal.next_samples(64, estimate));
  estimate.interval.to = 0.1;
  EXPECT_FALSE(goal.next_samples(64, estimate));
  EXPECT_TRUE(goal.is_reached());
}

TEST(ErrorGoal, SettlesOnlyWhereAPassHadAWideInterval) {
  ErrorEstimate estimate;
  estimate.relative_error = 0.1;
  const auto with_interval = [&](double from, double to) {
    estimate.interval = {from, to};
    return estimate;
  };
  ErrorGoal many_pixels(0.01, 1 << 24), few_pixels(0.01, 1 << 24);
  many_pixels.settled(64, with_interval(0.08, 0.13));
  EXPECT_EQ(many_pixels.settled(128, with_interval(0.095, 0.105)).interval.to, 0.105);
  few_pixels.settled(64, with_interval(0, 0.3));
  const ErrorEstimate settled = few_pixels.settled(128, with_interval(0.095, 0.105));
  EXPECT_DOUBLE_EQ(settled.interval.to, std::sqrt((0.3 * 0.3 / 2 + 0.105 * 0.105) / 2));
  EXPECT_DOUBLE_EQ(settled.interval.from, std::sqrt(0.095 * 0.095 / 2));
  // That pass has less than a quarter of the samples.
  EXPECT_EQ(few_pixels.settled(513, with_interval(0.095, 0.105)).interval.to, 0.105);
}

}  // namespace
}  // namespace sdlc::render
