#include "cli/report/axis.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include <gmock/gmock.h>

namespace sdlc::cli {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

LogAxis covering(std::vector<double> values) { return LogAxis(values); }

auto are(std::vector<double> values) { return testing::Pointwise(testing::DoubleEq(), values); }

TEST(LogAxis, TicksAreAtOneTwoAndFive) {
  EXPECT_THAT(covering({0.1, 8}).ticks(10), are({0.1, 0.2, 0.5, 1, 2, 5}));
}

TEST(LogAxis, IfThoseAreTooManyTicksAreAtPowersOfTen) {
  EXPECT_THAT(covering({0.1, 50}).ticks(6), are({0.1, 1, 10}));
}

TEST(LogAxis, CoversADecadeAtLeast) {
  EXPECT_THAT(covering({0.9, 1.3}).ticks(8), are({0.5, 1, 2}));
}

TEST(LogAxis, ManyDecadesHaveLabelsAtSomePowersOfTen) {
  const std::vector<double> values = covering({1e-9, 1e9}).ticks(8);
  EXPECT_THAT(values, testing::SizeIs(testing::AllOf(testing::Ge(3u), testing::Le(8u))));
  for (const double value : values) {
    EXPECT_DOUBLE_EQ(std::log10(value), std::round(std::log10(value)));
  }
}

TEST(LogAxis, SharesFollowLogarithms) {
  const LogAxis axis = covering({1, 100});
  EXPECT_NEAR(axis.share(10), 0.5, 1e-12);
  EXPECT_GT(axis.share(1), 0) << "the ends lie within";
  EXPECT_LT(axis.share(100), 1);
}

TEST(LogAxis, OneValueLiesInTheMiddle) { EXPECT_NEAR(covering({7, 7}).share(7), 0.5, 1e-12); }

TEST(LogAxis, WhatHasNoPlaceLiesAtAnEnd) {
  const LogAxis axis = covering({1, 100});
  for (const double value : {0.0, -3.0, -kInfinity, std::nan("")}) EXPECT_EQ(axis.share(value), 0);
  EXPECT_EQ(axis.share(kInfinity), 1);
}

TEST(LogAxis, OnlyNumbersAboveZeroAreCovered) {
  const LogAxis axis = covering({std::nan(""), kInfinity, 0, -1, 5});
  EXPECT_NEAR(axis.share(5), 0.5, 1e-12);
}

TEST(LogAxis, TheFarthestNumbersHaveAxesToo) {
  constexpr double kLeast = std::numeric_limits<double>::denorm_min();
  constexpr double kLargest = std::numeric_limits<double>::max();
  for (const std::vector<double>& values :
       {std::vector<double>{}, {kLeast}, {kLargest}, {kLeast, kLargest}}) {
    const LogAxis axis = covering(values);
    EXPECT_LE(axis.ticks(8).size(), 8u);
    for (const double tick : axis.ticks(8)) EXPECT_TRUE(std::isfinite(tick));
    for (const double value : values) {
      EXPECT_GE(axis.share(value), 0);
      EXPECT_LE(axis.share(value), 1);
    }
  }
}

}  // namespace
}  // namespace sdlc::cli
