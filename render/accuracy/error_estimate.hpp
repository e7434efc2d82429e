#pragma once

#include <optional>
#include <span>

#include "render/film/film.hpp"
#include "render/image/picture.hpp"
#include "render/math/interval.hpp"

namespace sdlc::render {

/// How far a picture is from what infinitely many samples would give, as far as its replicates say.
struct ErrorEstimate {
  /// The relative error: the root of the mean over pixels and channels of the squared error of the
  /// linear radiance, divided by the mean linear radiance. 0 of a black picture.
  double relative_error = 0;
  Interval interval;       ///< of 95 % for the error that this very picture has
  double mean = 0;         ///< of all pixels and channels: linear radiance
  Interval mean_interval;  ///< of 95 % for what infinitely many samples would give
};

/// The estimate from the spread of each pixel.
///
/// Let x_1 … x_4 be the means of a pixel's replicates, measured from the true value. The squared
/// error of the pixel is |x̄|², its estimate the unbiased variance of x̄; the first less the second
/// is the mean of x_i · x_j over the six pairs, whose variance is tr Σ² / 6 with the covariance
/// matrix Σ of one replicate, whatever its distribution: fourth moments cancel. Pixels are
/// independent of each other, so the variances of many add up (PooledVariance). That makes an
/// interval for the error of this very picture, twice as long as one for that of pictures like it
/// would be. Where rare and large samples make the error it is longer than it need be. Nothing
/// where squares of the radiance are no finite numbers, from 1e150 on, or vanish, below 1e-140.
std::optional<ErrorEstimate> estimate_error(const Picture& picture,
                                            std::span<const PixelSpread> spreads);

}  // namespace sdlc::render
