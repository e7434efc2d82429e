#include "render/compare/color_map.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace sdlc::test {
namespace {

using render::LinearRgb;
using render::mapped_color;

constexpr int kSteps = 256;

double luminance(LinearRgb c) { return 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b; }

/// The forward Oklab conversion, from linear RGB through the cone responses.
std::array<double, 3> oklab(LinearRgb c) {
  const double l = std::cbrt(0.4122214708 * c.r + 0.5363325363 * c.g + 0.0514459929 * c.b);
  const double m = std::cbrt(0.2119034982 * c.r + 0.6806995451 * c.g + 0.1073969566 * c.b);
  const double s = std::cbrt(0.0883024619 * c.r + 0.2817188376 * c.g + 0.6299787005 * c.b);
  return {0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s,
          1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s,
          0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s};
}

TEST(ColorMap, GoesFromNearlyBlackToNearlyWhite) {
  EXPECT_LT(luminance(mapped_color(0)), 0.005);
  EXPECT_GT(luminance(mapped_color(1)), 0.9);
}

// The order is visible without hues, in greyscale and without red-green vision, because only
// lightness is left.
TEST(ColorMap, OnlyGetsLighter) {
  for (int i = 1; i <= kSteps; ++i) {
    const LinearRgb before = mapped_color((i - 1.0) / kSteps),
                    after = mapped_color(1.0 * i / kSteps);
    EXPECT_GT(luminance(after), luminance(before)) << i;
    EXPECT_GT(oklab(after)[0] - oklab(before)[0], 0.0015) << i;
  }
}

TEST(ColorMap, ShowsEqualStepsAsEquallyLargeDifferences) {
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (int i = 1; i <= kSteps; ++i) {
    const auto p = oklab(mapped_color((i - 1.0) / kSteps)),
               q = oklab(mapped_color(1.0 * i / kSteps));
    const double step = std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
    least = std::min(least, step);
    most = std::max(most, step);
  }
  EXPECT_LT(most / least, 1.02);
}

TEST(ColorMap, HasOnlyColoursThatADisplayShows) {
  for (int i = 0; i <= 4 * kSteps; ++i) {
    const LinearRgb c = mapped_color(0.25 * i / kSteps);
    for (const double v : {c.r, c.g, c.b}) {
      EXPECT_GE(v, 0) << i;
      EXPECT_LE(v, 1) << i;
    }
  }
}

TEST(ColorMap, IsBlueThenRedThenYellow) {
  const LinearRgb blue = mapped_color(0.15), red = mapped_color(0.6), yellow = mapped_color(0.88);
  EXPECT_GT(blue.b, 4 * blue.r);
  EXPECT_GT(red.r, 4 * red.g);
  EXPECT_GT(red.r, 4 * red.b);
  EXPECT_GT(yellow.g, 4 * yellow.b);
}

TEST(ColorMap, HoldsItsEndsBeyondThem) {
  EXPECT_EQ(mapped_color(-3), mapped_color(0));
  EXPECT_EQ(mapped_color(7), mapped_color(1));
  EXPECT_EQ(mapped_color(std::numeric_limits<double>::quiet_NaN()), mapped_color(0));
}

TEST(ColorMap, MapsEachValueAsItsShareOfTheTop) {
  const std::vector<float> values{0, 1, 2, 4};
  const render::Picture picture = render::color_mapped(values, 2, 2, 4);
  EXPECT_EQ(picture.at(0, 0), mapped_color(0));
  EXPECT_EQ(picture.at(1, 0), mapped_color(0.25));
  EXPECT_EQ(picture.at(0, 1), mapped_color(0.5));
  EXPECT_EQ(picture.at(1, 1), mapped_color(1));
}

// Two equal pictures have a largest difference of 0.
TEST(ColorMap, IsDarkEverywhereUnderATopOfZero) {
  EXPECT_EQ(render::color_mapped(std::vector<float>{0}, 1, 1, 0).at(0, 0), mapped_color(0));
}

}  // namespace
}  // namespace sdlc::test
