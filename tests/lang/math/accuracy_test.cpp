#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "lang/math/elementary.hpp"
#include "tests/lang/math/arguments.hpp"

// The reference is the C library's long double: with 64 bits or more its own error, at most two of
// its units in the last place in each of up to three steps, is below 0.003 ulp of a double. Against
// quadruple precision the largest error was 0.5000000 ulp for each function, over 10^6 arguments.
namespace sdlc::lang {
namespace {

constexpr int kArguments = 100000;
constexpr long double kRightAngle = std::numbers::pi_v<long double> / 2;

class Accuracy : public testing::Test {
 protected:
  void SetUp() override {
    if (std::numeric_limits<long double>::digits < 64) GTEST_SKIP() << "no wider reference";
  }
  void TearDown() override {
    EXPECT_GT(compared_, kArguments / 4);
    EXPECT_LT(largest_, 0.505) << "at " << x_ << ", " << y_;
    RecordProperty("largest_error_in_ulp", std::to_string(largest_));
  }

  void compare(double value, long double reference, double x, double y = 0) {
    ++compared_;
    const int exponent = std::max(std::ilogb(reference), -1022);  // subnormal numbers share one ulp
    const auto error = static_cast<double>(std::ldexp(std::fabs(value - reference), 52 - exponent));
    if (error <= largest_) return;
    largest_ = error;
    x_ = x;
    y_ = y;
  }

  Arguments arguments;

 private:
  int compared_ = 0;
  double largest_ = 0, x_ = 0, y_ = 0;
};

/// Sine and cosine, with the argument reduced as exactly as ours: otherwise no digits are left next
/// to a zero.
std::pair<long double, long double> reference_sin_cos(double degrees) {
  const double rest = std::fmod(degrees, 360.0);
  const double quarters = std::round(rest / 90);
  const long double x = (rest - quarters * 90) / 90.0L * kRightAngle;
  std::pair value{std::sin(x), std::cos(x)};
  for (int turn = static_cast<int>(quarters) & 3; turn > 0; --turn) {
    value = {value.second, -value.first};
  }
  return value;
}

double any_angle(Arguments& arguments, int i) {
  switch (i % 3) {
    case 0: return arguments.between(-720, 720);
    case 1: return arguments.of_any_size_and_sign(-1074, 1022);
    default: return arguments.close_to(15 * std::floor(arguments.between(-50, 50)));
  }
}

double any_sine(Arguments& arguments, int i) {
  switch (i % 4) {
    case 0: return arguments.between(-1, 1);
    case 1: return arguments.of_any_size_and_sign(-1074, -1);
    case 2: return arguments.close_to(0.5);
    default: return std::clamp(arguments.close_to(i % 8 == 3 ? 1 : -1), -1.0, 1.0);
  }
}

long double degrees(long double radians) { return radians / kRightAngle * 90; }

TEST_F(Accuracy, OfSine) {
  for (int i = 0; i < kArguments; ++i) {
    const double x = any_angle(arguments, i);
    if (x != 0) compare(sin_degrees(x), reference_sin_cos(x).first, x);
  }
}

TEST_F(Accuracy, OfCosine) {
  for (int i = 0; i < kArguments; ++i) {
    const double x = any_angle(arguments, i);
    compare(cos_degrees(x), reference_sin_cos(x).second, x);
  }
}

TEST_F(Accuracy, OfTangent) {
  for (int i = 0; i < kArguments; ++i) {
    const double x = any_angle(arguments, i);
    const auto [sin, cos] = reference_sin_cos(x);
    if (const auto value = tan_degrees(x); value && x != 0) compare(*value, sin / cos, x);
  }
}

TEST_F(Accuracy, OfArcSine) {
  for (int i = 0; i < kArguments; ++i) {
    const double x = any_sine(arguments, i);
    compare(asin_degrees(x).value(), degrees(std::asin(static_cast<long double>(x))), x);
  }
}

TEST_F(Accuracy, OfArcCosine) {
  for (int i = 0; i < kArguments; ++i) {
    const double x = any_sine(arguments, i);
    if (x != 1)
      compare(acos_degrees(x).value(), degrees(std::acos(static_cast<long double>(x))), x);
  }
}

TEST_F(Accuracy, OfArcTangent) {
  for (int i = 0; i < kArguments; ++i) {
    const double x =
        i % 2 == 0 ? arguments.between(-8, 8) : arguments.of_any_size_and_sign(-1074, 1022);
    compare(atan_degrees(x), degrees(std::atan(static_cast<long double>(x))), x);
  }
}

TEST_F(Accuracy, OfTheAngleOfAPoint) {
  for (int i = 0; i < kArguments; ++i) {
    const int size = i % 2 == 0 ? 3 : 1022;
    const double x = arguments.of_any_size_and_sign(-size, size);
    const double y =
        i % 4 < 2 ? arguments.close_to(x) : arguments.of_any_size_and_sign(-size, size);
    const long double reference = std::atan2(static_cast<long double>(y), x);
    compare(atan2_degrees(y, x).value(), degrees(reference), y, x);
  }
}

TEST_F(Accuracy, OfExponential) {
  for (int i = 0; i < kArguments; ++i) {
    const double x =
        i % 2 == 0 ? arguments.between(-745, 709) : arguments.of_any_size_and_sign(-60, 8);
    compare(exp(x), std::exp(static_cast<long double>(x)), x);
  }
}

TEST_F(Accuracy, OfLogarithm) {
  for (int i = 0; i < kArguments; ++i) {
    const double x = i % 2 == 0 ? arguments.of_any_size(-1074, 1022) : arguments.close_to(1);
    if (x != 1) compare(log(x).value(), std::log(static_cast<long double>(x)), x);
  }
}

TEST_F(Accuracy, OfPower) {
  for (int i = 0; i < kArguments; ++i) {
    const double x = arguments.of_any_size(-20, 20);
    const double y = arguments.between(-48, 48);
    const long double reference = std::pow(static_cast<long double>(x), y);
    compare(power(x, y), reference, x, y);
  }
}

TEST_F(Accuracy, OfRadiansAndDegrees) {
  for (int i = 0; i < kArguments; ++i) {
    const double x = arguments.of_any_size_and_sign(-1074, 1016);
    compare(radians_from_degrees(x), x / 90.0L * kRightAngle, x);
    compare(degrees_from_radians(x), degrees(x), x);
  }
}

/// Whether `function` is monotonic over runs of neighbouring doubles in low ... high.
template <typename Function>
bool is_increasing(Function function, double low, double high) {
  Arguments arguments;
  for (int run = 0; run < 1000; ++run) {
    double x = arguments.between(low, high), value = function(x);
    for (int step = 0; step < 10; ++step) {
      x = std::min(std::nextafter(x, high), high);
      const double next = function(x);
      if (next < value) return false;
      value = next;
    }
  }
  return true;
}

TEST(Monotone, WhereTheTrueFunctionIs) {
  EXPECT_TRUE(is_increasing(sin_degrees, -90, 90));
  EXPECT_TRUE(is_increasing([](double x) { return -cos_degrees(x); }, 0, 180));
  EXPECT_TRUE(is_increasing([](double x) { return *tan_degrees(x); }, -89, 89));
  EXPECT_TRUE(is_increasing([](double x) { return *asin_degrees(x); }, -1, 1));
  EXPECT_TRUE(is_increasing([](double x) { return -*acos_degrees(x); }, -1, 1));
  EXPECT_TRUE(is_increasing(atan_degrees, -20, 20));
  EXPECT_TRUE(is_increasing(exp, -700, 700));
  EXPECT_TRUE(is_increasing([](double x) { return *log(x); }, 1e-3, 20));
  EXPECT_TRUE(is_increasing([](double x) { return power(x, 2.4); }, 1e-3, 20));
}

}  // namespace
}  // namespace sdlc::lang
