#pragma once

#include "render/image/picture.hpp"
#include "render/math/color.hpp"

namespace sdlc::render {

/// A picture of means, with the variance of each mean.
struct NoisyPicture {
  const Picture& mean;
  const Picture& variance;
};

/// Tests whether two pictures differ by more than their noise. H0: every value has the same
/// expectation in both. Assumes that the noise of all values is independent and that its variance
/// was estimated without bias. No distribution is assumed, only that many pixels are summed.
struct ZTest {
  /// Tests the means of the pictures per channel: Σ(a − b) / √Σ(va + vb), standard normal under H0.
  /// Finds missing or surplus light, however little each pixel has of it.
  LinearRgb mean_z;
  double mean_p = 1;  ///< two-sided, for the three channels together (Bonferroni)
  /// Tests the squared differences: D = Σ over channels of (a − b)² − va − vb has expectation 0
  /// under H0 in each pixel. The sum of all D divided by the root of the sum of their squares is
  /// approximately standard normal. Finds local differences that leave the mean unchanged.
  double noise_z = 0;
  double noise_p = 1;  ///< one-sided: less difference than the noise predicts is not evidence
                       ///< against H0

  /// The largest of |mean_z| and noise_z.
  double largest() const noexcept;
};

/// Precondition: all four pictures have the same size, at least one pixel and finite values;
/// variances are not negative. If the pictures differ where the variance is zero everywhere, z is
/// infinite.
ZTest z_test(const NoisyPicture& a, const NoisyPicture& b);

}  // namespace sdlc::render
