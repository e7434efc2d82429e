#include "render/accuracy/error_estimate.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace sdlc::render {
namespace {

/// The quantile at .975 of Student's t, by its series in 1 / ν (Abramowitz, Stegun, 26.7.5): 1 %
/// too small for 2 degrees of freedom, 11 % for 1.
double student_t_975(double degrees) {
  constexpr double z = 1.959963984540054, z2 = z * z;
  constexpr double g1 = z * (z2 + 1) / 4;
  constexpr double g2 = z * ((5 * z2 + 16) * z2 + 3) / 96;
  constexpr double g3 = z * (((3 * z2 + 19) * z2 + 17) * z2 - 15) / 384;
  constexpr double g4 = z * ((((79 * z2 + 776) * z2 + 1482) * z2 - 1920) * z2 - 945) / 92160;
  const double u = 1 / std::max(degrees, 1.0);
  return z + u * (g1 + u * (g2 + u * (g3 + u * g4)));
}

/// A sum of terms at least 0, and half the length of an interval of 95 % around it.
struct PooledVariance {
  double sum = 0, squares = 0;

  void add(double v) {
    sum += v;
    squares += v * v;
  }
  double half_width() const {
    if (!(sum > 0)) return 0;
    return student_t_975(sum * sum / squares) * std::sqrt(sum);
  }
};

}  // namespace

std::optional<ErrorEstimate> estimate_error(const Picture& picture,
                                            std::span<const PixelSpread> spreads) {
  // Numbers far from 1 would overflow where they are squared twice.
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
  const auto relative = [&](double squares) {
    return std::sqrt(std::max(0.0, squares) / values) * unit / estimate.mean;
  };
  const double half_width = of_squared_error.half_width();
  estimate.relative_error = relative(squared_error);
  estimate.interval = {relative(squared_error - half_width), relative(squared_error + half_width)};
  const double sum = squared_error + half_width + estimate.mean + mean_half_width;
  // Radiance whose squares are no numbers.
  if (!std::isfinite(sum) || !std::isfinite(unit)) return std::nullopt;
  return estimate;
}

}  // namespace sdlc::render
