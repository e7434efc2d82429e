#include "render/measure/reference_error.hpp"

#include <cmath>

#include <gtest/gtest.h>

// tests/statistics/measured_error_test.cpp tests the coverage of the intervals.
namespace sdlc::test {
namespace {

using render::LinearRgb;
using render::Measured;
using render::Picture;
using render::ReferencePicture;

ReferencePicture plain_reference(double radiance, float noise) {
  return {.picture = Picture(2, 1, LinearRgb{radiance}),
          .noise = {noise, noise},
          .covariance = {noise, noise}};
}

TEST(ErrorAgainstAReference, IsItsDistanceWithoutTheReferencesOwnNoise) {
  // 2 · 3 values with an error of .5, relative to a mean of 2; the reference's own squared error is
  // .3 per pixel.
  const ReferencePicture reference = plain_reference(2, std::sqrt(0.3f));
  const Measured error = error_against(Picture(2, 1, LinearRgb{2.5}), reference);
  EXPECT_NEAR(error.value, std::sqrt((6 * 0.25 - 0.6) / 6) / 2, 1e-7);
  EXPECT_LT(error.interval.from, error.value);
  EXPECT_GT(error.interval.to, error.value);
}

TEST(ErrorAgainstAReference, IsTheSameAtEveryScale) {
  const auto error_at = [](double scale) {
    return error_against(Picture(2, 1, LinearRgb{2.5 * scale}),
                         plain_reference(2 * scale, static_cast<float>(0.5 * scale)));
  };
  const Measured usual = error_at(1);
  for (const double scale : {1e-30, 1e-22, 1e22, 1e30}) {
    EXPECT_NEAR(error_at(scale).value, usual.value, 1e-6) << scale;
    EXPECT_NEAR(error_at(scale).interval.to, usual.interval.to, 1e-6) << scale;
  }
}

TEST(ErrorAgainstAReference, IsInfiniteOfLightWhereTheReferenceHasNone) {
  const ReferencePicture black = plain_reference(0, 0);
  EXPECT_EQ(error_against(Picture(2, 1), black).value, 0);
  EXPECT_EQ(error_against(Picture(2, 1, LinearRgb{1}), black).value, INFINITY);
  EXPECT_EQ(error_spread(Picture(2, 1, LinearRgb{1}), black), 0);
}

}  // namespace
}  // namespace sdlc::test
