#include "render/measure/against.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "tests/render/measure/points.hpp"

namespace sdlc::test {
namespace {

using render::Comparison;
using render::Point;
using render::Verdict;

/// Their times were repeated, and differed by 1 %.
std::vector<Point> some_points(double time = 1, double error = 1) {
  std::vector<Point> points{point(8, 1 * time, 0.1 * error), point(16, 2 * time, 0.07 * error),
                            point(32, 4 * time, 0.05 * error),
                            point(32, 5 * time, 0.06 * error, kIndependent)};
  for (Point& any : points) {
    any.timings = {0.99 * any.seconds.value, any.seconds.value, 1.01 * any.seconds.value};
  }
  return points;
}

TEST(Against, TheSameMeasurementIsNeitherBetterNorWorse) {
  const Comparison same = compare_measurements(some_points(), some_points(), true);
  ASSERT_EQ(same.points.size(), 4u);
  for (const auto& change : same.points) EXPECT_EQ(change.error, Verdict::NotDistinguished);
  EXPECT_EQ(same.time, Verdict::NotDistinguished);
  EXPECT_DOUBLE_EQ(same.time_ratio->value, 1);
}

TEST(Against, ALargerErrorIsWorseAndASmallerOneBetter) {
  EXPECT_EQ(compare_measurements(some_points(1, 1.1), some_points(), true).points[0].error,
            Verdict::Worse);
  EXPECT_EQ(compare_measurements(some_points(1, 0.9), some_points(), true).points[0].error,
            Verdict::Better);
}

TEST(Against, WhatDiffersFromSeedToSeedIsNoChange) {
  std::vector<Point> now = some_points(1, 1.1);
  for (Point& point : now) point.error_spread = 0.05 * point.error.value;
  EXPECT_EQ(compare_measurements(now, some_points(), true).points[0].error,
            Verdict::NotDistinguished);
}

TEST(Against, TimesThatAreLongerAllTogetherAreWorse) {
  const Comparison slower = compare_measurements(some_points(1.2), some_points(), true);
  EXPECT_EQ(slower.time, Verdict::Worse);
  EXPECT_NEAR(slower.time_ratio->value, 1.2, 1e-12);
  EXPECT_EQ(compare_measurements(some_points(0.8), some_points(), true).time, Verdict::Better);
  EXPECT_EQ(compare_measurements(some_points(1.03), some_points(), true).time,
            Verdict::NotDistinguished)
      << "machines drift by as much";
}

TEST(Against, TimesThatDifferByTheNoiseOfOneTimeAreNot) {
  std::vector<Point> now = some_points(1.2);
  for (Point& any : now) any.timings = {0.9 * any.seconds.value, 1.1 * any.seconds.value};
  EXPECT_EQ(compare_measurements(now, some_points(), true).time, Verdict::NotDistinguished)
      << "all points share what the machine was like";
}

TEST(Against, TimesOfAFewMillisecondsAreNotCompared) {
  EXPECT_FALSE(compare_measurements(some_points(0.001), some_points(0.001), true).time_ratio);
}

TEST(Against, AnErrorThatIsNoNumberIsNeither) {
  std::vector<Point> now = some_points();
  now[0].error.value = NAN;
  EXPECT_EQ(compare_measurements(now, some_points(), true).points[0].error,
            Verdict::NotDistinguished);
}

TEST(Against, TimesThatAreLongerHereAndShorterThereAreNot) {
  std::vector<Point> now = some_points(1.3);
  now[0] = point(8, 0.8, 0.1);
  now[2] = point(32, 3, 0.05);
  EXPECT_EQ(compare_measurements(now, some_points(), true).time, Verdict::NotDistinguished);
}

TEST(Against, TimesOfAnotherMachineAreNotCompared) {
  EXPECT_FALSE(compare_measurements(some_points(1.2), some_points(), false).time_ratio);
}

TEST(Against, PointsThatOnlyOneOfThemHasAreLeftOut) {
  const std::vector<Point> one{point(8, 1, 0.1), point(64, 8, 0.03)};
  const Comparison comparison = compare_measurements(one, some_points(), true);
  ASSERT_EQ(comparison.points.size(), 1u);
  EXPECT_EQ(comparison.points[0].samples, 8);
  EXPECT_FALSE(comparison.time_ratio) << "of one point there is none";
}

}  // namespace
}  // namespace sdlc::test
