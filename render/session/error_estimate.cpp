#include "render/session/error_estimate.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "render/session/pooled_variance.hpp"

namespace sdlc::render {

std::optional<ErrorEstimate> estimate_error(const Picture& picture,
                                            std::span<const PixelSpread> spreads) {
  // Scale to avoid overflow: values far from 1 are squared twice below.
  double largest = 0;
  for (const PixelSpread& spread : spreads) {
    if (!std::isfinite(spread.squared_error)) return std::nullopt;
    largest = std::max(largest, spread.squared_error);
  }
  const double scale = largest > 0 ? 1 / largest : 0;

  double total = 0, squared_error = 0;
  PooledVariance of_squared_error, of_mean;
  for (std::size_t i = 0; i < spreads.size(); ++i) {
    const LinearRgb& pixel = picture.pixels[i];
    total += (pixel.r + pixel.g + pixel.b) / 3;
    squared_error += spreads[i].squared_error * scale;
    const double covariance = spreads[i].covariance * scale;
    of_squared_error.add(covariance * covariance / 6);
    of_mean.add(spreads[i].grey_variance * scale);
  }
  const double pixels = static_cast<double>(spreads.size()), values = 3 * pixels;
  const double unit = scale > 0 ? std::sqrt(largest) : 0;  // √(1 / scale)

  ErrorEstimate estimate;
  estimate.mean = total / pixels;
  const double mean_half_width = of_mean.half_width() * unit / pixels;
  estimate.mean_interval = {estimate.mean - mean_half_width, estimate.mean + mean_half_width};
  if (estimate.mean == 0) return estimate;
  constexpr double kMinMean = 1e-140;  // below this, squares of differences underflow
  if (estimate.mean < kMinMean) return std::nullopt;
  const auto relative = [&](double squares) {
    return std::sqrt(std::max(0.0, squares) / values) * unit / estimate.mean;
  };
  const double half_width = of_squared_error.half_width();
  estimate.relative_error = relative(squared_error);
  estimate.interval = {relative(squared_error - half_width), relative(squared_error + half_width)};
  const double sum = squared_error + half_width + estimate.mean + mean_half_width;
  // The squares overflowed.
  if (!std::isfinite(sum) || !std::isfinite(unit)) return std::nullopt;
  return estimate;
}

std::optional<ErrorEstimate> estimate_error(const ErrorEstimate& plain,
                                            std::span<const DenoisedError> errors) {
  double sum = 0, noise = 0;
  PooledVariance of_sum, of_noise;
  for (const DenoisedError& error : errors) {
    sum += error.squared_error;
    noise += error.noise;
    of_sum.add(error.variance);
    of_noise.add(error.variance_of_noise);
  }
  // The squared bias, what is not noise, is estimated, and may come out negative. It is not: then
  // the error is the noise, and the interval that of noise.
  const double half_width = std::max(of_sum.half_width(), of_noise.half_width());
  if (!std::isfinite(sum + half_width)) return std::nullopt;
  const auto relative = [&](double squares) {
    return std::sqrt(std::max(0.0, squares) / (3 * static_cast<double>(errors.size())));
  };
  ErrorEstimate estimate = plain;
  estimate.relative_error = relative(std::max(sum, noise));
  estimate.interval = {relative(sum - half_width), relative(std::max(sum, noise) + half_width)};
  return estimate;
}

}  // namespace sdlc::render
