#include "render/math/exp2.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace sdlc::render {
namespace {

TEST(Exp2, IsExactForWholeNumbers) {
  for (int e = -1074; e < 1024; ++e) EXPECT_EQ(exp2_reproducible(e), std::ldexp(1.0, e));
}

TEST(Exp2, IsWithinAUnitInTheLastPlace) {
  for (int i = 0; i < 100000; ++i) {
    const double v = (i + 0.37) / 2500 - 20;
    const double got = exp2_reproducible(v);
    const auto error = static_cast<double>(got - exp2l(v));
    ASSERT_LE(std::fabs(error), std::ldexp(1.0, std::ilogb(got) - 52)) << v;
  }
}

TEST(Exp2, HasTheSameBitsOnEveryMachine) {
  EXPECT_EQ(exp2_reproducible(0.5), 0x1.6a09e667f3bccp+0);  // the nearest double ends in d
  EXPECT_EQ(exp2_reproducible(1.0 / 3), 0x1.428a2f98d728bp+0);
  EXPECT_EQ(exp2_reproducible(-7.3), 0x1.9fdf8bcce533ep-8);
}

TEST(Exp2, IsInfiniteOrZeroBeyondTheRangeOfDouble) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const double v : {1024.0, 1e9, kInfinity}) EXPECT_EQ(exp2_reproducible(v), kInfinity);
  for (const double v : {-1076.0, -1e9, -kInfinity}) EXPECT_EQ(exp2_reproducible(v), 0);
  EXPECT_EQ(exp2_reproducible(std::nan("")), 0);
}

}  // namespace
}  // namespace sdlc::render
