#include "render/measure/trade.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "tests/render/measure/points.hpp"

namespace sdlc::test {
namespace {

using render::Dominance;
using render::Point;
using render::Series;

/// Errors of 8 / samples^.75 and times of `samples` milliseconds.
std::vector<Point> sobol_points() {
  std::vector<Point> points;
  for (int samples = 8; samples <= 512; samples *= 4) {
    points.push_back(point(samples, 1e-3 * samples, 0.4 * std::pow(samples / 8.0, -0.75)));
  }
  return points;
}

TEST(MarkDominance, WhatIsSlowerAndWorseBeyondTheIntervalsIsDominated) {
  std::vector<Point> points{point(8, 1, 0.1), point(16, 2, 0.05), point(16, 3, 0.07, kIndependent)};
  mark_dominance(points);
  EXPECT_EQ(points[0].dominance, Dominance::Front);
  EXPECT_EQ(points[1].dominance, Dominance::Front);
  EXPECT_EQ(points[2].dominance, Dominance::Dominated);
}

TEST(MarkDominance, WhatIsSlowerAndWorseWithinThemIsNotDistinguished) {
  std::vector<Point> points{point(16, 2, 0.05), point(16, 2.05, 0.07, kIndependent),
                            point(16, 3, 0.051, kIndependent)};
  mark_dominance(points);
  EXPECT_EQ(points[1].dominance, Dominance::NotDistinguished) << "their times overlap";
  EXPECT_EQ(points[2].dominance, Dominance::NotDistinguished) << "their errors overlap";
}

TEST(MarkDominance, TheSamePictureMadeMoreSlowlyIsDominated) {
  std::vector<Point> points{point(16, 2, 0.05), point(16, 3, 0.05, kIndependent)};
  mark_dominance(points);
  EXPECT_EQ(points[0].dominance, Dominance::Front);
  EXPECT_EQ(points[1].dominance, Dominance::Dominated);
}

TEST(MarkDominance, WhatIsClearlySlowerAndHardlyNearerIsNotDistinguished) {
  std::vector<Point> points{point(16, 2, 0.05), point(16, 3, 0.0499, kIndependent)};
  mark_dominance(points);
  EXPECT_EQ(points[1].dominance, Dominance::NotDistinguished);
}

TEST(GroupByConfiguration, HaveTheSlopeOfTheirLine) {
  std::vector<Point> points = sobol_points();
  points.push_back(point(16, 1, 0.3, kIndependent));
  const std::vector<Series> series = group_by_configuration(points);
  ASSERT_EQ(series.size(), 2u);
  ASSERT_TRUE(series[0].slope);
  EXPECT_NEAR(series[0].slope->value, -0.75, 1e-12);
  EXPECT_NEAR(series[0].slope->interval.to, -0.75, 1e-9) << "the points are on the line";
  EXPECT_FALSE(series[1].slope) << "of one point there is none";
}

TEST(GroupByConfiguration, SayHowFarTheirPointsAreFromTheLine) {
  std::vector<Point> points = sobol_points();
  points[1].error = measured(points[1].error.value * 1.3, 0.02);
  const Series series = group_by_configuration(points).front();
  EXPECT_LT(series.slope->interval.from, -0.8);
  EXPECT_GT(series.slope->interval.to, -0.7);
}

TEST(SamplesForAnError, AreMeasuredWhereAPointHasItAlready) {
  const std::vector<Point> points = sobol_points();
  const auto found =
      samples_for(points[0].error.interval.to, group_by_configuration(points).front(), points);
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->is_measured);
  EXPECT_EQ(found->samples, 8);
}

TEST(SamplesForAnError, AreBetweenPointsOnTheLineThroughThem) {
  const std::vector<Point> points = sobol_points();
  // 8 (.4 / .1)^(4/3) = 50.8 for the error itself, 52 for the interval's upper end.
  const auto found = samples_for(0.1, group_by_configuration(points).front(), points);
  ASSERT_TRUE(found);
  EXPECT_FALSE(found->is_measured);
  EXPECT_EQ(found->samples, 56) << "the next of 4, 5, 6, 7 times a power of two";
  EXPECT_NEAR(found->error.value, 0.4 * std::pow(7, -0.75), 1e-9);
  EXPECT_LE(found->error.interval.to, 0.1);
  EXPECT_NEAR(found->seconds, 0.056, 1e-9);
}

TEST(SamplesForAnError, AreBeyondThePointsByTheSlopeAndNotForEver) {
  const std::vector<Point> points = sobol_points();
  const Series series = group_by_configuration(points).front();
  const double last = points.back().error.value;
  const auto found = samples_for(last / 4, series, points);
  ASSERT_TRUE(found);
  EXPECT_FALSE(found->is_measured);
  EXPECT_NEAR(found->samples, 512 * std::pow(4, 4 / 3.0), 512);
  EXPECT_LE(found->error.interval.to, last / 4);
  EXPECT_FALSE(samples_for(last / 1000, series, points));
}

TEST(GroupByConfiguration, HaveAnUncertainSlopeOfTwoPoints) {
  const std::vector<Point> points{point(16, 1, 0.1), point(64, 4, 0.05)};
  const Series series = group_by_configuration(points).front();
  ASSERT_TRUE(series.slope);
  EXPECT_NEAR(series.slope->value, -0.5, 1e-12);
  EXPECT_LT(series.slope->interval.from, -0.6) << "not exact, though no point is off the line";
  EXPECT_GT(series.slope->interval.to, -0.4);
}

TEST(Recommendations, KnowAConfigurationOfTwoPointsBeyondThem) {
  std::vector<Point> points{point(8, 1, 0.4), point(32, 4, 0.2), point(128, 16, 0.1)};
  const render::Configuration lights{.light_sampling = render::LightSampling::On};
  points.push_back(point(16, 3, 0.02, lights));
  points.push_back(point(64, 12, 0.01, lights));
  const auto found =
      recommend(0.008, group_by_configuration(points), points, render::NoiseOfTime({}));
  ASSERT_TRUE(found);
  EXPECT_EQ(found->configuration, lights);
  EXPECT_FALSE(found->is_measured);
  EXPECT_GT(found->samples, 100) << "64 (.01 / .008)² = 100, and more to be sure";
  EXPECT_LT(found->samples, 400);
}

TEST(SamplesForAnError, DoNotComeOfASeriesThatStandsStill) {
  std::vector<Point> points{point(8, 1, 0.1), point(32, 2, 0.1), point(128, 3, 0.1)};
  EXPECT_FALSE(samples_for(0.01, group_by_configuration(points).front(), points));
}

TEST(SamplesForAnError, OfAPictureWithoutNoiseAreThoseOfItsPoint) {
  std::vector<Point> points{point(8, 1, 0.1), point(32, 2, 0)};
  const auto found = samples_for(0.01, group_by_configuration(points).front(), points);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->samples, 32);
  EXPECT_TRUE(found->is_measured);
}

TEST(Goals, AreRoundErrorsThatThePointsReach) {
  const std::vector<Point> points{point(8, 1, 0.15), point(128, 2, 0.018)};
  EXPECT_EQ(render::worthwhile_goals(points, {}), (std::vector{0.1, 0.05, 0.02, 0.01}));
  EXPECT_EQ(render::worthwhile_goals(points, 0.03), (std::vector{0.1, 0.05, 0.03, 0.02, 0.01}));
  EXPECT_TRUE(render::worthwhile_goals({}, {}).empty());
}

TEST(Recommendations, TakeTheFastestConfiguration) {
  std::vector<Point> points{point(8, 1, 0.1), point(32, 4, 0.05)};
  const render::Configuration lights{.light_sampling = render::LightSampling::On};
  points.push_back(point(8, 1.5, 0.04, lights));
  const auto series = group_by_configuration(points);
  const render::NoiseOfTime noise({});
  const auto found = recommend(0.055, series, points, noise);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->configuration, lights);
  EXPECT_EQ(found->samples, 8);
  EXPECT_TRUE(found->is_measured);
  EXPECT_DOUBLE_EQ(found->seconds.value, 1.5);
  EXPECT_LT(found->seconds.interval.from, 1.5);
  EXPECT_GT(found->seconds.interval.to, 1.5);
}

TEST(Recommendations, KeepTheScenesOwnConfigurationUnlessAnotherIsClearlyFaster) {
  std::vector<Point> points{point(8, 1, 0.1), point(32, 4, 0.05)};
  points.push_back(point(32, 3.9, 0.05, kIndependent));
  const auto found =
      recommend(0.055, group_by_configuration(points), points, render::NoiseOfTime({}));
  ASSERT_TRUE(found);
  EXPECT_EQ(found->configuration, render::Configuration{});
}

TEST(Recommendations, NeverChangeTheDepth) {
  const render::Configuration shallow{.depth = 4};
  const std::vector<Point> points{point(32, 4, 0.05), point(32, 1, 0.05, shallow)};
  const auto found =
      recommend(0.055, group_by_configuration(points), points, render::NoiseOfTime({}));
  ASSERT_TRUE(found);
  EXPECT_EQ(found->configuration, render::Configuration{});
}

}  // namespace
}  // namespace sdlc::test
