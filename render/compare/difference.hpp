#pragma once

#include <array>
#include <string_view>

#include "render/image/picture.hpp"

namespace sdlc::render {

/// By the index of the channel.
inline constexpr std::array<std::string_view, 3> kChannelNames{"red", "green", "blue"};

/// The largest difference of two pictures, in one channel of one pixel.
struct LargestDifference {
  double value = 0;  ///< picture less reference
  int x = 0, y = 0;  ///< of the pixel, from the top left; of several the first, row by row
  int channel = 0;   ///< of kChannelNames
};

/// How far a picture is from a reference of the same size, in the values that they hold: linear
/// radiance, or codes from 0 to 1. Differences are taken in each channel of each pixel.
struct Difference {
  double rmse = 0;  ///< root of the mean of the squared difference
  /// rmse divided by the mean of the reference: what `render --error` means by an error. Infinite
  /// where that mean is 0 and rmse is not.
  double relative_error = 0;
  /// Mean of (picture − reference)² / (reference² + 0.01), after Rousselle, Knaus and Zwicker,
  /// "Adaptive sampling and reconstruction using greedy error minimization", 2011.
  double relative_mse = 0;
  /// The same without the hundredth of the pixels that have the most of it. Descriptive: it says
  /// how most of the picture fares, and nothing of rare bright pixels, which are an error too.
  double trimmed_relative_mse = 0;
  double psnr = 0;  ///< 20 log10(1 / rmse) in decibels, of a peak of 1; infinite for equal pictures
  LargestDifference largest;
};

/// Precondition: both have the same size, at least one pixel, and finite values.
Difference measure_difference(const Picture& picture, const Picture& reference);

}  // namespace sdlc::render
