#include "render/math/sincos.hpp"

#include <cmath>
#include <tuple>

#include <gtest/gtest.h>

namespace sdlc::render {
namespace {

TEST(SinCosTurns, IsExactAtQuarterTurns) {
  EXPECT_EQ(sincos_turns(0).sin, 0);
  EXPECT_EQ(sincos_turns(0).cos, 1);
  EXPECT_EQ(sincos_turns(0.25).sin, 1);
  EXPECT_EQ(sincos_turns(0.25).cos, 0);
  EXPECT_EQ(sincos_turns(0.5).sin, 0);
  EXPECT_EQ(sincos_turns(0.5).cos, -1);
  EXPECT_EQ(sincos_turns(0.75).sin, -1);
}

TEST(SinCosTurns, IsWithinTwoUnitsInTheLastPlace) {
  // Two units, not one: the angle in radians is rounded once before the series.
  for (int i = 0; i < 100000; ++i) {
    const double v = (i + 0.37) / 100000;
    // The reference also reduces the angle first: near a zero even long double would lose it
    // otherwise.
    const int quadrant = static_cast<int>(std::lround(v * 4));
    const long double x = (v * 4 - quadrant) * (3.14159265358979323846264338327950288L / 2);
    long double s = sinl(x), c = cosl(x);
    for (int turn = 0; turn < quadrant; ++turn) std::tie(s, c) = std::pair{c, -s};
    const SinCos value = sincos_turns(v);
    for (const auto& [got, wanted] : {std::pair{value.sin, s}, {value.cos, c}}) {
      const double ulp = std::ldexp(1.0, std::ilogb(std::fabs(got)) - 52);
      ASSERT_LE(std::fabs(got - static_cast<double>(wanted)), 2 * ulp) << v;
    }
  }
}

}  // namespace
}  // namespace sdlc::render
