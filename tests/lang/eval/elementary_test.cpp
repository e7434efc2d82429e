#include "lang/eval/elementary.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace sdlc::lang
