#pragma once

#include <span>
#include <vector>

#include "render/denoise/cross_filter.hpp"
#include "render/film/film.hpp"
#include "render/film/first_hits.hpp"
#include "render/image/picture.hpp"

namespace sdlc::render {

/// How far a pixel of a denoised picture is from the limit of infinitely many samples, in units of
/// the mean radiance of the picture.
struct DenoisedError {
  /// An unbiased estimate of the squared error, of noise and of bias together, summed over
  /// channels. It may be negative.
  double squared_error = 0;
  double noise = 0;     ///< the part of it that noise has on average
  double variance = 0;  ///< of this estimate; only sums over many pixels have a meaning
  double variance_of_noise = 0;  ///< the part of it that no bias has added; not negative
};

struct Denoised {
  Picture picture;
  std::vector<DenoisedError> errors;  ///< by pixel
};

/// Filters the means of a film with all pixels of a picture, each with samples in all replicates.
/// The picture is not black.
/// `filter`: of the backend. `features`: of samples that are independent of the film's. `spreads`:
/// of the film.
///
/// The filter makes a value F_i from all replicates but x_i. Both are independent, so |F_i − x_i|²
/// less the variance of x_i is an unbiased estimate of |F_i − t|², where t is the limit of
/// infinitely many samples. The picture is the mean F of all F_i, and |F − t|² is the mean of
/// |F_i − t|² less that of |F_i − F|².
///
/// With independent noise ε of variance s² in one replicate, F_i − t = b_p + Σ w_pq ε_q for a pixel
/// p. The variance of the estimate is then b_p² s_p² + s_p⁴ (1 − 2 w_pp)² / 6 + (4 / 6) Σ w_pq²
/// s_p² s_q², the sum being over the other pixels q, if w_pq = w_qp.
Denoised denoise(CrossFilter& filter, const Film& film, std::span<const PixelFeatures> features,
                 std::span<const PixelSpread> spreads, int width, int height);

}  // namespace sdlc::render
