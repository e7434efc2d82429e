#include "render/compare/flip.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "render/image/tone.hpp"
#include "render/parallel/workers.hpp"

namespace sdlc::test {
namespace {

using render::flip;
using render::FlipMap;
using render::LinearRgb;
using render::Picture;
using testing::Each;

Picture noise(int width, int height, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  Picture picture(width, height);
  for (LinearRgb& c : picture.pixels) c = {uniform(random), uniform(random), uniform(random)};
  return picture;
}

TEST(Flip, SeesNothingBetweenEqualPictures) {
  const Picture picture = noise(40, 70, 1);
  const FlipMap map = flip(picture, picture);
  EXPECT_EQ(map.width, 40);
  EXPECT_EQ(map.height, 70);
  EXPECT_EQ(map.values.size(), 40u * 70u);
  EXPECT_THAT(map.values, Each(0));
  EXPECT_EQ(map.mean, 0);
}

// Pure green and blue have the largest distance in the metric. There are no features, so the result
// is the colour difference alone: 1.
TEST(Flip, IsOneBetweenGreenAndBlue) {
  const FlipMap map = flip(Picture(30, 30, {0, 1, 0}), Picture(30, 30, {0, 0, 1}));
  EXPECT_NEAR(map.mean, 1, 1e-7);
}

// White and black differ only by 100 in lightness, and cmax is 41.2760… as in the published
// program: 0.95 + (100^0.7 - 0.4 cmax) / (0.6 cmax) * 0.05.
TEST(Flip, HasThePublishedLargestDistance) {
  constexpr double kLargest = 41.27602;
  const double expected = 0.95 + 0.05 * (std::pow(100, 0.7) - 0.4 * kLargest) / (0.6 * kLargest);
  EXPECT_NEAR(flip(Picture(9, 9, LinearRgb(1)), Picture(9, 9, LinearRgb(0))).mean, expected, 1e-6);
}

// Below the knee: the greys of lightness 50 and 40 differ by 10.
TEST(Flip, ExpandsSmallDifferences) {
  const auto grey = [](double lightness) { return LinearRgb(std::pow((lightness + 16) / 116, 3)); };
  const double expected = 0.95 / (0.4 * 41.27602) * std::pow(10, 0.7);
  EXPECT_NEAR(flip(Picture(9, 9, grey(50)), Picture(9, 9, grey(40))).mean, expected, 1e-6);
}

TEST(Flip, DoesNotDependOnWhichIsTheReference) {
  const Picture a = noise(50, 40, 1), b = noise(50, 40, 2);
  EXPECT_EQ(flip(a, b).values, flip(b, a).values);
}

TEST(Flip, CutsOffWhatADisplayDoesNotShow) {
  Picture a = noise(40, 40, 1), b = noise(40, 40, 2);
  a.at(7, 7) = {1, 0, 1};
  const FlipMap cut = flip(a, b);
  a.at(7, 7) = {1000, -3, 1};
  EXPECT_EQ(flip(a, b).values, cut.values);
}

TEST(Flip, IsBetweenZeroAndOne) {
  // Alternating lines of black and white against the same shifted by one: features everywhere.
  Picture a(64, 64), b(64, 64);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) (x % 2 == 0 ? a : b).at(x, y) = LinearRgb(1);
  }
  for (const double pixels_per_degree : {1.0, 10.0, 67.0, 200.0}) {
    const FlipMap map = flip(a, b, pixels_per_degree);
    EXPECT_GE(*std::ranges::min_element(map.values), 0) << pixels_per_degree;
    EXPECT_LE(*std::ranges::max_element(map.values), 1 + 1e-6) << pixels_per_degree;
    EXPECT_FALSE(std::isnan(map.mean)) << pixels_per_degree;
  }
}

// The eye blurs fine noise: from farther away less of it is visible.
TEST(Flip, SeesLessOfNoiseFromFartherAway) {
  const Picture a = noise(60, 60, 1), b = noise(60, 60, 2);
  EXPECT_LT(flip(a, b, 100).mean, 0.5 * flip(a, b, 10).mean);
}

TEST(Flip, GivesTheSameBitsForAnyNumberOfThreads) {
  const Picture a = noise(33, 200, 1), b = noise(33, 200, 2);
  const auto map = [&] { return flip(a, b); };
  const FlipMap one = render::Workers(1).run(map), five = render::Workers(5).run(map);
  EXPECT_EQ(one.values, five.values);
  EXPECT_EQ(one.mean, five.mean);
}

// The border repeats: a picture of a single pixel is a uniform colour.
TEST(Flip, RepeatsTheBorder) {
  const Picture a = noise(1, 1, 1), b = noise(1, 1, 2);
  EXPECT_EQ(flip(a, b).mean,
            flip(Picture(30, 45, a.at(0, 0)), Picture(30, 45, b.at(0, 0))).values[15]);
}

}  // namespace
}  // namespace sdlc::test
