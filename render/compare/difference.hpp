#pragma once

#include <array>
#include <string_view>

#include "render/image/picture.hpp"

namespace sdlc::render {

/// Indexed by channel.
inline constexpr std::array<std::string_view, 3> kChannelNames{"red", "green", "blue"};

/// The largest difference between two pictures, in one channel of one pixel.
struct LargestDifference {
  double value = 0;  ///< picture minus reference
  int x = 0, y = 0;  ///< pixel, from the top left; the first one in row order if there are several
  int channel = 0;   ///< index into kChannelNames
};

/// How far a picture is from a reference of the same size. Values are linear radiance or codes in
/// [0, 1]; differences are per channel and pixel.
struct Difference {
  double rmse = 0;  ///< root of the mean of the squared difference
  /// rmse divided by the mean of the reference, the error that `render --error` reports. Infinite
  /// if that mean is 0 and rmse is not.
  double relative_error = 0;
  /// Mean of (picture − reference)² / (reference² + 0.01), after Rousselle, Knaus and Zwicker,
  /// "Adaptive sampling and reconstruction using greedy error minimization", 2011.
  double relative_mse = 0;
  /// The same without the 1 % of pixels with the largest terms. A descriptive statistic: it shows
  /// how well most of the picture agrees, and ignores rare bright pixels, which are errors too.
  double trimmed_relative_mse = 0;
  double psnr = 0;  ///< 20 log10(1 / rmse) in decibels, for a peak of 1; infinite for equal
                    ///< pictures
  LargestDifference largest;
};

/// Precondition: both have the same size, at least one pixel, and finite values.
Difference measure_difference(const Picture& picture, const Picture& reference);

}  // namespace sdlc::render
