#pragma once

#include <optional>
#include <span>

#include "render/denoise/denoise.hpp"
#include "render/film/film.hpp"
#include "render/image/picture.hpp"
#include "render/math/interval.hpp"

namespace sdlc::render {

/// Estimates how far a picture is from the limit of infinitely many samples, from its replicates.
struct ErrorEstimate {
  /// The root of the mean squared error of the linear radiance, over pixels and channels, divided
  /// by the mean linear radiance. 0 for a black picture.
  double relative_error = 0;
  Interval interval;       ///< 95 % confidence interval for the error of this very picture
  double mean = 0;         ///< mean linear radiance over pixels and channels
  Interval mean_interval;  ///< 95 % confidence interval for the limit of infinitely many samples
};

/// Estimates the error from the spread of each pixel.
///
/// Let x_1 … x_4 be the means of a pixel's replicates, measured from the true value. The squared
/// error of the pixel is |x̄|², and its estimate is the unbiased variance of x̄. The difference of
/// the two is the mean of x_i · x_j over the six pairs; its variance is tr Σ² / 6, where Σ is the
/// covariance matrix of one replicate. This holds for any distribution, because fourth moments
/// cancel. Pixels are independent of each other, so their variances add up (PooledVariance).
///
/// The interval covers the error of this very picture; it is twice as long as an interval for the
/// expected error of such pictures. Where rare bright samples dominate the error it is longer than
/// necessary.
///
/// Returns nullopt where squares of the radiance overflow (from 1e150) or underflow (below 1e-140).
std::optional<ErrorEstimate> estimate_error(const Picture& picture,
                                            std::span<const PixelSpread> spreads);

/// The error of a denoised picture whose error was `plain` before. The mean radiance stays that of
/// the plain picture: a filter may change it. Returns nullopt if squares overflow.
std::optional<ErrorEstimate> estimate_error(const ErrorEstimate& plain,
                                            std::span<const DenoisedError> errors);

}  // namespace sdlc::render
