#include "render/compare/difference.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace sdlc::test {
namespace {

using render::Difference;
using render::LinearRgb;
using render::measure_difference;
using render::Picture;

TEST(Difference, OfEqualPicturesIsNothing) {
  const Picture picture(7, 5, LinearRgb(0.1, 0.2, 0.3));
  const Difference difference = measure_difference(picture, picture);
  EXPECT_EQ(difference.rmse, 0);
  EXPECT_EQ(difference.relative_error, 0);
  EXPECT_EQ(difference.relative_mse, 0);
  EXPECT_EQ(difference.trimmed_relative_mse, 0);
  EXPECT_EQ(difference.largest.value, 0);
  EXPECT_TRUE(std::isinf(difference.psnr) && difference.psnr > 0);
}

// One value of 2 × 2 × 3 is off by 0.6 where the reference is 0.5 everywhere.
TEST(Difference, HasTheValuesOfItsFormulas) {
  const Picture reference(2, 2, LinearRgb(0.5));
  Picture picture = reference;
  picture.at(1, 0).g = -0.1;
  const Difference difference = measure_difference(picture, reference);
  EXPECT_DOUBLE_EQ(difference.rmse, std::sqrt(0.36 / 12));
  EXPECT_DOUBLE_EQ(difference.relative_error, std::sqrt(0.36 / 12) / 0.5);
  EXPECT_DOUBLE_EQ(difference.relative_mse, 0.36 / 0.26 / 12);
  EXPECT_DOUBLE_EQ(difference.psnr, 10 * std::log10(12 / 0.36));
  EXPECT_DOUBLE_EQ(difference.largest.value, -0.6);
  EXPECT_EQ(difference.largest.x, 1);
  EXPECT_EQ(difference.largest.y, 0);
  EXPECT_EQ(difference.largest.channel, 1);
}

TEST(Difference, TellsTheFirstOfSeveralLargest) {
  const Picture reference(3, 3);
  Picture picture = reference;
  picture.at(2, 1).b = 1;
  picture.at(0, 2).r = -1;
  const auto largest = measure_difference(picture, reference).largest;
  EXPECT_EQ(largest.x, 2);
  EXPECT_EQ(largest.y, 1);
  EXPECT_EQ(largest.channel, 2);
}

TEST(Difference, IsWithoutBoundBesideABlackReference) {
  const Difference difference = measure_difference(Picture(2, 2, LinearRgb(0.1)), Picture(2, 2));
  EXPECT_TRUE(std::isinf(difference.relative_error));
  EXPECT_DOUBLE_EQ(difference.relative_mse, 0.01 / 0.01);
}

TEST(Difference, OfTwoBlackPicturesIsNothing) {
  EXPECT_EQ(measure_difference(Picture(2, 2), Picture(2, 2)).relative_error, 0);
}

TEST(Difference, IsTrimmedOfTheWorstHundredth) {
  const Picture reference(20, 10, LinearRgb(1));
  Picture picture(20, 10, LinearRgb(1.1));
  picture.at(3, 3) = picture.at(4, 4) = LinearRgb(1000);
  const Difference difference = measure_difference(picture, reference);
  EXPECT_NEAR(difference.trimmed_relative_mse, 0.01 / 1.01, 1e-12);
  EXPECT_GT(difference.relative_mse, 9000);
  picture.at(5, 5) = LinearRgb(1000);
  EXPECT_GT(measure_difference(picture, reference).trimmed_relative_mse, 4000) << "two in 200";
}

}  // namespace
}  // namespace sdlc::test
