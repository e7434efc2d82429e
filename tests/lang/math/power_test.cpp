#include <cmath>
#include <limits>
#include <optional>

#include <gtest/gtest.h>

#include "lang/math/elementary.hpp"
#include "tests/lang/math/arguments.hpp"

namespace sdlc::lang {
namespace {

TEST(Power, IsExactWhereTheResultIs) {
  EXPECT_EQ(power(2, 10), 1024.0);
  EXPECT_EQ(power(10, 22), 1e22);
  EXPECT_EQ(power(3, 33), 5559060566555523.0);
  EXPECT_EQ(power(2, -1074), 5e-324);
  EXPECT_EQ(power(2, 1023), 0x1p1023);
  EXPECT_EQ(power(0.25, 0.5), 0.5);
  EXPECT_EQ(power(1, 1e300), 1.0);
  EXPECT_EQ(power(5e-324, 1), 5e-324);
}

TEST(Power, IsTheNearestDouble) {
  // From a computation with 60 decimal digits.
  EXPECT_EQ(power(3.301e-11, 1.062), 7.392673857208403e-12);
  EXPECT_EQ(power(6.284e-06, 2.494), 1.0636555826718625e-13);
  EXPECT_EQ(power(106900.0, -10.43), 3.529901076285613e-53);
  EXPECT_EQ(power(3.363e-20, 8.099), 1.931794380457505e-158);
  EXPECT_EQ(power(2.367e-10, -6.376), 2.3665294177381372e+61);
  EXPECT_EQ(power(6.696e+19, -0.7137), 7.084602970878996e-15);
  EXPECT_EQ(power(28740000000000.0, -0.5675), 2.3030786086156963e-08);
  EXPECT_EQ(power(365400.0, -8.385), 2.270835980363596e-47);
  EXPECT_EQ(power(248000.0, 8.833), 4.458530036175524e+47);
  EXPECT_EQ(power(8.458, 5.79), 233819.0393619518);
  EXPECT_EQ(power(7186000.0, -10.46), 1.910485533077942e-72);
  EXPECT_EQ(power(21340000000.0, 2.186), 3.798560006192918e+22);
  EXPECT_EQ(power(1.124e-08, -11.26), 3.2238240847251267e+89);
  EXPECT_EQ(power(417900000000000.0, -0.654), 2.74042972296092e-10);
  EXPECT_EQ(power(566200000.0, 9.092), 3.819460410586766e+79);
  EXPECT_EQ(power(367400000.0, 10.11), 3.922444672437197e+86);
  EXPECT_EQ(power(6.288e-05, 7.222), 4.537927086585173e-31);
  EXPECT_EQ(power(0.006093, 10.45), 7.103719614470586e-24);
  EXPECT_EQ(power(1428000000000000.0, -9.661), 3.89198168531434e-147);
  EXPECT_EQ(power(2.746e-15, -6.792), 7.949612881457544e+98);
  EXPECT_EQ(power(4.161e+18, -1.532), 2.988058524711592e-29);
  EXPECT_EQ(power(116400.0, -4.775), 6.457650239868488e-25);
  EXPECT_EQ(power(1.949, -2.739), 0.16077013359801762);
  EXPECT_EQ(power(1.087e-06, 2.042), 6.637136187432134e-13);
}

TEST(Power, KeepsItsBounds) {
  EXPECT_EQ(power(2, 1024), std::numeric_limits<double>::infinity());
  EXPECT_EQ(power(0.5, 1e308), 0.0);
  EXPECT_EQ(power(2, -1076), 0.0);
  EXPECT_EQ(power(2, 1e308), std::numeric_limits<double>::infinity());
  EXPECT_EQ(power(0.5, -1e308), std::numeric_limits<double>::infinity());
}

TEST(Power, IsWithinAnUlpOfTheHostsEverywhere) {
  for (double x = 1e-3; x < 1e3; x *= 1.0173) {
    for (double y = -20; y < 20; y += 0.37) {
      const double host = std::pow(x, y);
      EXPECT_LE(std::fabs(power(x, y) - host), std::nextafter(host, INFINITY) - host)
          << x << "^" << y;
    }
  }
}

TEST(Raise, MultipliesForSquaresAndCubes) {
  Arguments arguments;
  for (int i = 0; i < 1000; ++i) {
    const double x = arguments.of_any_size_and_sign(-30, 30);
    EXPECT_EQ(raise(x, 1), x);
    EXPECT_EQ(raise(x, 2), x * x);
    EXPECT_EQ(raise(x, 3), x * x * x);
    EXPECT_EQ(raise(x, -1), 1 / x);
  }
}

TEST(Raise, TakesNegativeNumbersToWholePowers) {
  EXPECT_EQ(raise(-2, 10), 1024.0);
  EXPECT_EQ(raise(-2, 11), -2048.0);
  EXPECT_EQ(raise(-2, -3), -0.125);
  EXPECT_EQ(raise(-1, 0x1p53 - 1), -1.0);
  EXPECT_EQ(raise(-1, 0x1p53), 1.0);
  EXPECT_EQ(raise(-8, 1.0 / 3), std::nullopt);
  EXPECT_EQ(raise(-1, 0.5), std::nullopt);
}

TEST(Raise, KnowsZero) {
  EXPECT_EQ(raise(0, 0), 1.0);
  EXPECT_EQ(raise(5, 0), 1.0);
  EXPECT_EQ(raise(0, 0.5), 0.0);
  EXPECT_EQ(raise(0, 7), 0.0);
  EXPECT_EQ(raise(0, -1), std::nullopt);
  EXPECT_EQ(raise(0, -0.5), std::nullopt);
}

TEST(Raise, IsInfiniteWhereTheResultIsTooLarge) {
  EXPECT_EQ(raise(10, 309), std::numeric_limits<double>::infinity());
  EXPECT_EQ(raise(-10, 309), -std::numeric_limits<double>::infinity());
  EXPECT_EQ(raise(1e200, 2), std::numeric_limits<double>::infinity());
}

TEST(Exponential, IsExactOrBoundedAtItsEnds) {
  EXPECT_EQ(exp(0), 1.0);
  EXPECT_EQ(exp(1), 0x1.5bf0a8b145769p+1);
  EXPECT_EQ(exp(5e-324), 1.0);
  EXPECT_EQ(exp(0x1.62e42fefa39efp+9), 0x1.fffffffffff2ap+1023);  // the largest finite result
  EXPECT_EQ(exp(0x1.62e42fefa39f0p+9), std::numeric_limits<double>::infinity());
  EXPECT_EQ(exp(-0x1.74910d52d3051p+9), 5e-324);  // the smallest result above 0
  EXPECT_EQ(exp(-0x1.74910d52d3052p+9), 0.0);
  EXPECT_EQ(exp(1.7976931348623157e308), std::numeric_limits<double>::infinity());
  EXPECT_EQ(exp(-1.7976931348623157e308), 0.0);
}

TEST(Logarithm, KnowsOneAndItsDomain) {
  EXPECT_EQ(log(1), 0.0);
  EXPECT_EQ(log(2), 0x1.62e42fefa39efp-1);
  EXPECT_EQ(log(5e-324), -0x1.74385446d71c3p+9);
  EXPECT_EQ(log(0), std::nullopt);
  EXPECT_EQ(log(-1), std::nullopt);
}

}  // namespace
}  // namespace sdlc::lang
