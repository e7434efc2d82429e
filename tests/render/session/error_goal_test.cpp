#include "render/session/error_goal.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "render/session/goal_render.hpp"
#include "render/shading/emitter_tally.hpp"

namespace sdlc::render {
namespace {

/// An error that falls as a power of the samples, known to 2 %.
ErrorEstimate error_of(double samples, double of_one, double slope) {
  ErrorEstimate estimate;
  estimate.relative_error = of_one * std::pow(samples, slope);
  estimate.interval = {0.98 * estimate.relative_error, 1.02 * estimate.relative_error};
  return estimate;
}

constexpr std::uint64_t kMost = 1 << 24;

/// The samples of all passes until the goal is reached.
std::vector<std::uint64_t> passes(const ErrorGoal& goal, double slope) {
  std::vector<std::uint64_t> all{goal.first_samples()};
  while (!goal.is_reached(error_of(static_cast<double>(all.back()), 1, slope))) {
    const std::uint64_t next = goal.samples_after(all.back());
    if (next == all.back()) break;
    all.push_back(next);
  }
  return all;
}

TEST(ErrorGoal, IsReachedWithAnEighthMoreSamplesThanItTakesAtMost) {
  for (const double slope : {-0.5, -0.57, -0.75}) {
    for (const double error : {0.1, 0.01, 0.003}) {
      const ErrorGoal goal(error, kMost);
      const auto spent = static_cast<double>(passes(goal, slope).back());
      EXPECT_TRUE(goal.is_reached(error_of(spent, 1, slope)));
      const double needed = std::pow(error / 1.02, 1 / slope);
      EXPECT_LE(spent, std::max(32.0, 1.125 * needed + 4)) << error << ", slope " << slope;
    }
  }
}

TEST(ErrorGoal, FallsWithAPowerOfTheSamples) {
  EXPECT_NEAR(min_error(0.08, 16), 0.01, 1e-12);
  EXPECT_NEAR(usual_growth(0.5), 3.374, 1e-3);
  EXPECT_EQ(usual_growth(1), 1);
}

TEST(ErrorGoal, AddsAnEighthAtMostInWholeReplicates) {
  const std::vector<std::uint64_t> all = passes(ErrorGoal(1e-3, kMost), -0.5);
  ASSERT_GT(all.size(), 40u);
  for (std::size_t i = 1; i < all.size(); ++i) {
    EXPECT_GT(all[i], all[i - 1]);
    EXPECT_LE(all[i], all[i - 1] + std::max<std::uint64_t>(4, all[i - 1] / 8));
    EXPECT_EQ(all[i] % 4, 0u);
  }
}

// So a render that is resumed with another goal has the passes of a new one.
TEST(ErrorGoal, TakesStepsThatDependNeitherOnTheGoalNorOnTheMaximum) {
  const std::vector<std::uint64_t> all = passes(ErrorGoal(1e-3, kMost), -0.5);
  for (const double error : {0.1, 0.02, 0.005}) {
    const std::vector<std::uint64_t> few = passes(ErrorGoal(error, 3000), -0.5);
    ASSERT_LT(few.size(), all.size());
    for (std::size_t i = 0; i + 1 < few.size(); ++i) EXPECT_EQ(few[i], all[i]);
    // Also after a pass that a maximum cut short.
    EXPECT_EQ(ErrorGoal(error, kMost).samples_after(all[few.size()] - 1), all[few.size()]);
  }
}

TEST(ErrorGoal, EndsWithTheMostSamples) {
  for (const std::uint64_t most : {1u, 7u, 16u, 99u}) {
    EXPECT_EQ(passes(ErrorGoal(1e-9, most), -0.5).back(), most);
  }
}

TEST(ErrorGoal, IsReachedByTheUpperEndOfTheInterval) {
  const ErrorGoal goal(0.1, kMost);
  ErrorEstimate estimate;
  estimate.relative_error = 0.099;
  estimate.interval = {0.097, 0.1001};
  EXPECT_FALSE(goal.is_reached(estimate));
  estimate.interval.to = 0.1;
  EXPECT_TRUE(goal.is_reached(estimate));
}

TEST(ErrorGoal, ForgetsAPassThatWasCutShort) {
  ErrorEstimate wide, narrow;
  wide.relative_error = narrow.relative_error = 0.1;
  wide.interval = {0, 0.3};
  narrow.interval = {0.095, 0.105};
  ErrorGoal goal(0.01, kMost), resumed(0.01, kMost);
  EXPECT_GT(goal.settled(77, wide).interval.to, 0.29);
  goal.record(77, wide, true);
  resumed.restore(goal.passes());
  EXPECT_EQ(resumed.settled(80, narrow).interval.to, 0.105);
}

TEST(ErrorGoal, SettlesOnlyWhereAPassHadAWideInterval) {
  ErrorEstimate estimate;
  estimate.relative_error = 0.1;
  const auto with_interval = [&](double from, double to) {
    estimate.interval = {from, to};
    return estimate;
  };
  ErrorGoal many_pixels(0.01, 1 << 24), few_pixels(0.01, 1 << 24);
  many_pixels.record(64, with_interval(0.08, 0.13), false);
  EXPECT_EQ(many_pixels.settled(128, with_interval(0.095, 0.105)).interval.to, 0.105);
  few_pixels.record(64, with_interval(0, 0.3), false);
  const ErrorEstimate settled = few_pixels.settled(128, with_interval(0.095, 0.105));
  EXPECT_DOUBLE_EQ(settled.interval.to, std::sqrt((0.3 * 0.3 / 2 + 0.105 * 0.105) / 2));
  EXPECT_DOUBLE_EQ(settled.interval.from, std::sqrt(0.095 * 0.095 / 2));
  // That pass has less than a quarter of the samples.
  EXPECT_EQ(few_pixels.settled(513, with_interval(0.095, 0.105)).interval.to, 0.105);
}

TEST(ErrorGoal, IsNotReachedWhileItIsBlindAndMoreMayBeSeen) {
  ErrorGoal goal(0.1, kMost);
  const EmitterTally emitters(EmitterClasses{}, 8);
  const auto record = [&](std::uint64_t samples, bool is_blind) {
    goal.record(samples, error_of(static_cast<double>(samples), 1, -0.5), is_blind);
    return may_see_more(goal, emitters, samples);
  };
  EXPECT_FALSE(record(32, false));
  EXPECT_TRUE(record(64, true));
  EXPECT_TRUE(record(72, false)) << "also in a render that ends here because of --samples";
  EXPECT_FALSE(record(128, false));
}

TEST(ErrorGoal, IsBlindForTheRestOfAnOctave) {
  ErrorGoal goal(0.01, kMost);
  ErrorEstimate estimate;
  std::vector<std::uint64_t> blind;
  for (std::uint64_t samples = goal.first_samples(); samples < 300;
       samples = goal.samples_after(samples)) {
    goal.record(samples, estimate, samples == 40 || samples == 132);
    if (goal.is_blind()) blind.push_back(samples);
  }
  const std::vector<std::uint64_t> rest{40, 44, 48, 52, 56, 60, 132, 148, 164, 184, 204, 228};
  EXPECT_EQ(blind, rest);
}

}  // namespace
}  // namespace sdlc::render
