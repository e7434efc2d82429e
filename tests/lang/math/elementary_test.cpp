#include "lang/math/elementary.hpp"

#include <cmath>
#include <limits>
#include <optional>

#include <gtest/gtest.h>

#include "tests/lang/math/arguments.hpp"

namespace sdlc::lang {
namespace {

constexpr double kSmallest = 5e-324, kLargest = std::numeric_limits<double>::max();

TEST(SinDegrees, IsExactWhereTheSineIsRational) {
  for (const double turns : {-7.0, -1.0, 0.0, 1.0, 1000.0, 0x1p60}) {
    const double turn = turns * 360;
    EXPECT_EQ(sin_degrees(turn), 0.0);
    if (turns > 0x1p45) continue;  // turn + 30 is not a double
    EXPECT_EQ(sin_degrees(turn + 30), 0.5);
    EXPECT_EQ(sin_degrees(turn + 90), 1.0);
    EXPECT_EQ(sin_degrees(turn + 150), 0.5);
    EXPECT_EQ(sin_degrees(turn + 180), 0.0);
    EXPECT_EQ(sin_degrees(turn + 210), -0.5);
    EXPECT_EQ(sin_degrees(turn + 270), -1.0);
    EXPECT_EQ(sin_degrees(turn + 330), -0.5);
  }
}

TEST(CosDegrees, IsExactWhereTheCosineIsRational) {
  for (const double turns : {-7.0, -1.0, 0.0, 1.0, 1000.0, 0x1p60}) {
    const double turn = turns * 360;
    EXPECT_EQ(cos_degrees(turn), 1.0);
    if (turns > 0x1p45) continue;  // turn + 60 is not a double
    EXPECT_EQ(cos_degrees(turn + 60), 0.5);
    EXPECT_EQ(cos_degrees(turn + 90), 0.0);
    EXPECT_EQ(cos_degrees(turn + 120), -0.5);
    EXPECT_EQ(cos_degrees(turn + 180), -1.0);
    EXPECT_EQ(cos_degrees(turn + 240), -0.5);
    EXPECT_EQ(cos_degrees(turn + 270), 0.0);
    EXPECT_EQ(cos_degrees(turn + 300), 0.5);
  }
}

TEST(TanDegrees, IsExactOnDiagonalsAndHasNoValueBetweenThem) {
  for (double turn = -3600; turn <= 3600; turn += 180) {
    EXPECT_EQ(tan_degrees(turn), 0.0);
    EXPECT_EQ(tan_degrees(turn + 45), 1.0);
    EXPECT_EQ(tan_degrees(turn + 90), std::nullopt);
    EXPECT_EQ(tan_degrees(turn + 135), -1.0);
  }
  EXPECT_GT(tan_degrees(std::nextafter(90.0, 0.0)), 1e15);
  EXPECT_LT(tan_degrees(std::nextafter(90.0, 91.0)), -1e15);
}

TEST(Trigonometry, HasTheSymmetriesOfTheCircle) {
  Arguments arguments;
  for (int i = 0; i < 1000; ++i) {
    const double x = arguments.of_any_size(-1074, 1022);
    EXPECT_EQ(sin_degrees(-x), -sin_degrees(x));
    EXPECT_EQ(cos_degrees(-x), cos_degrees(x));
    const double whole = std::floor(arguments.between(0, 0x1p40));
    EXPECT_EQ(sin_degrees(whole), cos_degrees(90 - whole));
    EXPECT_EQ(sin_degrees(whole), -sin_degrees(whole + 180));
  }
}

TEST(Trigonometry, OfTheSmallestAngleIsTheAngle) {
  // 57 of the smallest double is nearest to one radian's worth of degrees.
  EXPECT_EQ(sin_degrees(57 * kSmallest), kSmallest);
  EXPECT_EQ(tan_degrees(57 * kSmallest), kSmallest);
  EXPECT_EQ(sin_degrees(kSmallest), 0.0);
  EXPECT_EQ(cos_degrees(kSmallest), 1.0);
  EXPECT_EQ(asin_degrees(kSmallest), 57 * kSmallest);
  EXPECT_EQ(atan_degrees(kSmallest), 57 * kSmallest);
  EXPECT_EQ(acos_degrees(kSmallest), 90.0);
}

TEST(AsinDegrees, IsExactAtHalves) {
  EXPECT_EQ(asin_degrees(0), 0.0);
  EXPECT_EQ(asin_degrees(0.5), 30.0);
  EXPECT_EQ(asin_degrees(-0.5), -30.0);
  EXPECT_EQ(asin_degrees(1), 90.0);
  EXPECT_EQ(asin_degrees(-1), -90.0);
  EXPECT_EQ(asin_degrees(std::nextafter(1.0, 2.0)), std::nullopt);
  EXPECT_EQ(asin_degrees(-2), std::nullopt);
}

TEST(AcosDegrees, IsExactAtHalves) {
  EXPECT_EQ(acos_degrees(1), 0.0);
  EXPECT_EQ(acos_degrees(0.5), 60.0);
  EXPECT_EQ(acos_degrees(0), 90.0);
  EXPECT_EQ(acos_degrees(-0.5), 120.0);
  EXPECT_EQ(acos_degrees(-1), 180.0);
  EXPECT_EQ(acos_degrees(std::nextafter(1.0, 2.0)), std::nullopt);
  EXPECT_EQ(acos_degrees(-2), std::nullopt);
}

TEST(Atan2Degrees, IsExactOnAxesAndDiagonals) {
  for (const double r : {kSmallest, 3e-310, 1e-160, 0.1, 1.0, 7.0, 1e200, kLargest}) {
    EXPECT_EQ(atan2_degrees(0, r), 0.0);
    EXPECT_EQ(atan2_degrees(r, r), 45.0);
    EXPECT_EQ(atan2_degrees(r, 0), 90.0);
    EXPECT_EQ(atan2_degrees(r, -r), 135.0);
    EXPECT_EQ(atan2_degrees(0, -r), 180.0);
    EXPECT_EQ(atan2_degrees(-0.0, -r), 180.0);
    EXPECT_EQ(atan2_degrees(-r, -r), -135.0);
    EXPECT_EQ(atan2_degrees(-r, 0), -90.0);
    EXPECT_EQ(atan2_degrees(-r, r), -45.0);
  }
  EXPECT_EQ(atan2_degrees(0, 0), std::nullopt);
  EXPECT_EQ(atan2_degrees(-0.0, -0.0), std::nullopt);
}

TEST(Atan2Degrees, TakesPointsOfVeryUnequalCoordinates) {
  EXPECT_EQ(atan2_degrees(kSmallest, kLargest), 0.0);
  EXPECT_EQ(atan2_degrees(kSmallest, -kLargest), 180.0);
  EXPECT_EQ(atan2_degrees(-kSmallest, -kLargest), -180.0);
  EXPECT_EQ(atan2_degrees(kLargest, kSmallest), 90.0);
  EXPECT_EQ(atan2_degrees(-kLargest, -kSmallest), -90.0);
  EXPECT_EQ(atan2_degrees(kSmallest, 1), 57 * kSmallest);
  EXPECT_EQ(atan2_degrees(-kSmallest, 0x1p-20), -60078979 * kSmallest);  // 2^20 180 / pi
}

TEST(AngleUnits, AreTheNearestDoubles) {
  EXPECT_EQ(radians_from_degrees(180), 0x1.921fb54442d18p+1);
  EXPECT_EQ(degrees_from_radians(0x1.921fb54442d18p+1), 180.0);
  EXPECT_EQ(degrees_from_radians(1), 0x1.ca5dc1a63c1f8p+5);
  EXPECT_EQ(radians_from_degrees(0), 0.0);
  EXPECT_EQ(radians_from_degrees(kLargest), 0x1.1df46a2529d39p+1018);
  EXPECT_EQ(degrees_from_radians(kLargest), std::numeric_limits<double>::infinity());
}

TEST(RoundHalfAway, GoesAwayFromZeroOnTies) {
  EXPECT_EQ(round_half_away(0.5), 1.0);
  EXPECT_EQ(round_half_away(1.5), 2.0);
  EXPECT_EQ(round_half_away(2.5), 3.0);
  EXPECT_EQ(round_half_away(-0.5), -1.0);
  EXPECT_EQ(round_half_away(-2.5), -3.0);
  EXPECT_EQ(round_half_away(2.4), 2.0);
  EXPECT_EQ(round_half_away(-2.6), -3.0);
}

TEST(RoundHalfAway, IsNotDeceivedByTheSumWithAHalf) {
  EXPECT_EQ(round_half_away(0.49999999999999994), 0.0);
  EXPECT_EQ(round_half_away(0x1p52 + 1), 0x1p52 + 1);
  EXPECT_EQ(round_half_away(0x1p51 + 0.5), 0x1p51 + 1);
  EXPECT_EQ(round_half_away(-kLargest), -kLargest);
}

TEST(Modulo, HasTheSignOfTheDivisor) {
  EXPECT_EQ(modulo(5.5, 2), 1.5);
  EXPECT_EQ(modulo(-5.5, 2), 0.5);
  EXPECT_EQ(modulo(5.5, -2), -0.5);
  EXPECT_EQ(modulo(-5.5, -2), -1.5);
  EXPECT_EQ(modulo(-4, 2), 0.0);
  EXPECT_EQ(modulo(0, 3), 0.0);
  EXPECT_EQ(modulo(1, 0), std::nullopt);
}

TEST(Modulo, IsExactForAnyMagnitudes) {
  // From a computation with fractions.
  EXPECT_EQ(modulo(1e300, 7), 1.0);
  EXPECT_EQ(modulo(-1e300, 7), 6.0);
  EXPECT_EQ(modulo(1e300, -7), -6.0);
  EXPECT_EQ(modulo(1e16, 0.1), 0x1.6fb9fb52b3338p-5);
  EXPECT_EQ(modulo(-1e16, 0.1), 0x1.c37937e07fffcp-5);
  EXPECT_EQ(modulo(kLargest, 3 * kSmallest), 2 * kSmallest);
  EXPECT_EQ(modulo(-1e-20, 1), 1.0);  // the nearest double
}

}  // namespace
}  // namespace sdlc::lang
