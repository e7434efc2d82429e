#include "render/session/error_estimate.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace sdlc::render {
namespace {

Picture grey_picture(std::size_t pixels, double value) {
  return Picture(static_cast<int>(pixels), 1, LinearRgb{value});
}

TEST(EstimateError, DividesTheRootOfTheMeanSquareByTheMean) {
  // 400 pixels of radiance 2, each with an error of √(3 · .01) over its three channels.
  const std::vector<PixelSpread> spreads(
      400, {.squared_error = 0.03, .covariance = std::sqrt(6e-4), .grey_variance = 1e-4});
  const ErrorEstimate estimate = *estimate_error(grey_picture(400, 2), spreads);
  EXPECT_DOUBLE_EQ(estimate.mean, 2);
  EXPECT_NEAR(estimate.relative_error, 0.05, 1e-15);
  // Σ tr Σ² / 6 = .04, t quantile 1.966 for 400 degrees of freedom: Σ = 12 ± 1.966 · .2.
  EXPECT_NEAR(estimate.interval.from, std::sqrt((12 - 1.9659 * 0.2) / 1200) / 2, 1e-6);
  EXPECT_NEAR(estimate.interval.to, std::sqrt((12 + 1.9659 * 0.2) / 1200) / 2, 1e-6);
  EXPECT_NEAR(estimate.mean_interval.to, 2 + 1.9659 * std::sqrt(0.04) / 400, 1e-7);
  EXPECT_NEAR(estimate.mean_interval.from, 2 - 1.9659 * std::sqrt(0.04) / 400, 1e-7);
}

TEST(EstimateError, CountsOnlyThePixelsThatMatter) {
  // One of 100 has all the noise: the t quantile for one degree of freedom is 12.7, by the series
  // 11.3.
  std::vector<PixelSpread> spreads(100);
  spreads[17] = {.squared_error = 1, .covariance = std::sqrt(6e-4), .grey_variance = 0};
  const ErrorEstimate estimate = *estimate_error(grey_picture(100, 1), spreads);
  EXPECT_NEAR(estimate.interval.to, std::sqrt((1 + 0.01 * 11.3) / 300), 2e-4);
}

TEST(EstimateError, IsZeroWhereNothingDiffersAndOfABlackPicture) {
  const std::vector<PixelSpread> spreads(9);
  for (const double value : {0.0, 0.4}) {
    const ErrorEstimate estimate = *estimate_error(grey_picture(9, value), spreads);
    EXPECT_EQ(estimate.relative_error, 0);
    EXPECT_EQ(estimate.interval, Interval{});
    EXPECT_EQ(estimate.mean_interval, (Interval{estimate.mean, estimate.mean}));
  }
}

TEST(EstimateError, DoesNotDependOnTheUnitOfRadiance) {
  const auto relative = [](double unit) {
    const double squared = unit * unit;
    const std::vector<PixelSpread> spreads(
        50, {.squared_error = 0.03 * squared, .covariance = 1e-2 * squared});
    return *estimate_error(grey_picture(50, unit), spreads);
  };
  EXPECT_EQ(relative(0x1p480).relative_error, relative(1).relative_error);
  EXPECT_EQ(relative(0x1p480).interval, relative(1).interval);
  EXPECT_EQ(relative(0x1p-480).interval, relative(1).interval);
}

TEST(EstimateError, OfADenoisedPictureIsAtLeastItsNoise) {
  ErrorEstimate plain;
  plain.relative_error = 0.5;
  // 100 pixels whose noise is .03 each, known to √(.04 / 100).
  std::vector<DenoisedError> errors(
      100, {.squared_error = 0.05, .noise = 0.03, .variance = 0.06, .variance_of_noise = 0.04});
  const double t = 1.984;  // quantile of 100 degrees of freedom
  ErrorEstimate estimate = *estimate_error(plain, errors);
  EXPECT_NEAR(estimate.relative_error, std::sqrt(5.0 / 300), 1e-12);
  EXPECT_NEAR(estimate.interval.to, std::sqrt((5 + t * std::sqrt(6)) / 300), 1e-3);
  // By chance, the squared bias of most pixels is estimated as negative: that has to show neither
  // in the error nor in the width of the interval.
  for (DenoisedError& error : errors) error = {-0.01, 0.03, -0.02, 0.04};
  estimate = *estimate_error(plain, errors);
  EXPECT_NEAR(estimate.relative_error, std::sqrt(3.0 / 300), 1e-12);
  EXPECT_EQ(estimate.interval.from, 0);
  EXPECT_NEAR(estimate.interval.to, std::sqrt((3 + t * std::sqrt(4)) / 300), 1e-3);
}

TEST(EstimateError, SaysNothingWhereSquaresAreNoNumbers) {
  const std::vector<PixelSpread> spreads(50, {.squared_error = HUGE_VAL, .covariance = HUGE_VAL});
  EXPECT_FALSE(estimate_error(grey_picture(50, 1e200), spreads));
  const std::vector<PixelSpread> none(50, {.squared_error = NAN});
  EXPECT_FALSE(estimate_error(grey_picture(50, 1), none));
}

}  // namespace
}  // namespace sdlc::render
