#pragma once

#include "render/image/picture.hpp"
#include "render/math/color.hpp"

namespace sdlc::render {

/// A picture of means, and the variance of each of these means.
struct NoisyPicture {
  const Picture& mean;
  const Picture& variance;
};

/// Whether two pictures differ by more than their noise. H0: every value of both has the same
/// expectation. The noise of all values is independent, with the variance that is estimated
/// without bias; no distribution is assumed, but that many pixels are summed up.
struct ZTest {
  /// Of the means of the pictures, channel by channel: Σ(a − b) / √Σ(va + vb), standard normal
  /// under H0. Finds light that is missing or added, however little a pixel has of it.
  LinearRgb mean_z;
  double mean_p = 1;  ///< two-sided, of the three channels together (Bonferroni)
  /// Of the squared differences: D = Σ over channels of (a − b)² − va − vb has the expectation 0
  /// under H0 in each pixel, and the sum of all D divided by the root of the sum of their squares
  /// is about standard normal. Finds what differs in place while the mean stays.
  double noise_z = 0;
  double noise_p = 1;  ///< one-sided: less than noise is no difference

  /// The largest of the |mean_z| and noise_z.
  double largest() const noexcept;
};

/// Precondition: all four are of one size, with at least one pixel and finite values; variances
/// are not negative. A sum of differences where there is no variance at all has an infinite z.
ZTest z_test(const NoisyPicture& a, const NoisyPicture& b);

}  // namespace sdlc::render
