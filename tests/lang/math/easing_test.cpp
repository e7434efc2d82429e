#include "lang/math/easing.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace sdlc::lang {
namespace {

/// Calls the function with each curve.
template <typename Function>
void for_each_curve(Function function) {
  for (const std::string_view name : kEaseCurveNames) {
    SCOPED_TRACE(name);
    function(find_ease_curve(name));
  }
}

TEST(Easing, IsExactAtAndBeyondTheEnds) {
  for_each_curve([](EaseCurve curve) {
    for (const auto ease : {ease_in, ease_out, ease_in_out}) {
      EXPECT_EQ(ease(curve, 0), 0);
      EXPECT_EQ(ease(curve, -3), 0);
      EXPECT_EQ(ease(curve, 1), 1);
      EXPECT_EQ(ease(curve, 1e300), 1);
    }
    EXPECT_EQ(ease_in_out(curve, 0.5), 0.5);
  });
}

TEST(Easing, OutIsInMirrored) {
  for_each_curve([](EaseCurve curve) {
    for (int i = 0; i <= 64; ++i) {
      const double t = i / 64.0;
      EXPECT_EQ(ease_out(curve, t), 1 - ease_in(curve, 1 - t));
      EXPECT_EQ(ease_in_out(curve, t / 2), ease_in(curve, t) / 2);
      EXPECT_EQ(ease_in_out(curve, 1 - t / 2), 1 - ease_in(curve, t) / 2);
    }
  });
}

TEST(Easing, HasNoJumps) {
  constexpr int kSteps = 100'000;
  constexpr double kMaxSlope = 60;  // elastic: 1200 degrees are 20.9 radians
  for_each_curve([](EaseCurve curve) {
    if (curve == EaseCurve::Circ) return;  // vertical at the end
    double largest = 0;
    for (int i = 0; i < kSteps; ++i) {
      const double t = static_cast<double>(i) / kSteps, next = static_cast<double>(i + 1) / kSteps;
      largest = std::max(largest, std::fabs(ease_in(curve, next) - ease_in(curve, t)));
    }
    EXPECT_LE(largest, kMaxSlope / kSteps);
  });
}

TEST(Easing, FollowsItsFormulas) {
  const double t = 0.3;
  const auto ease = [&](std::string_view name) { return ease_in(find_ease_curve(name), t); };
  EXPECT_NEAR(ease("sine"), 1 - std::cos(t * M_PI / 2), 1e-15);
  EXPECT_NEAR(ease("quad"), 0.09, 1e-15);
  EXPECT_NEAR(ease("cubic"), 0.027, 1e-15);
  EXPECT_NEAR(ease("quart"), 0.0081, 1e-15);
  EXPECT_NEAR(ease("expo"), (std::pow(2, 10 * t) - 1) / 1023, 1e-15);
  EXPECT_NEAR(ease("circ"), 1 - std::sqrt(1 - t * t), 1e-15);
  EXPECT_NEAR(ease("back"), 2.70158 * t * t * t - 1.70158 * t * t, 1e-15);
  EXPECT_NEAR(ease("elastic"), (std::pow(2, 10 * t) - 1) / 1023 * std::cos(20 * M_PI / 3 * (1 - t)),
              1e-14);
}

TEST(Easing, BouncesAtTheGroundThreeTimes) {
  const EaseCurve bounce = EaseCurve::Bounce;
  for (const double contact : {4 / 11.0, 8 / 11.0, 10 / 11.0}) {
    EXPECT_NEAR(ease_out(bounce, contact), 1, 1e-14);
  }
  EXPECT_NEAR(ease_out(bounce, 6 / 11.0), 1 - 1 / 4.0, 1e-15);
  EXPECT_NEAR(ease_out(bounce, 9 / 11.0), 1 - 1 / 16.0, 1e-15);
  EXPECT_NEAR(ease_out(bounce, 10.5 / 11.0), 1 - 1 / 64.0, 1e-15);
}

}  // namespace
}  // namespace sdlc::lang
