#include "render/measure/reference_error.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "render/image/layer.hpp"
#include "render/session/pooled_variance.hpp"

namespace sdlc::render {
namespace {

double squared_distance(const LinearRgb& a, const LinearRgb& b) {
  const LinearRgb d = a - b;
  return d.r * d.r + d.g * d.g + d.b * d.b;
}

/// The replicate estimates for one pixel of the reference.
struct PixelNoise {
  double squared_error, covariance;
};

PixelNoise noise_of(const ReferencePicture& reference, std::size_t pixel) {
  const double noise = reference.noise[pixel], covariance = reference.covariance[pixel];
  return {noise * noise, covariance * covariance};
}

/// tr Σ² / (tr Σ)² of the noise: from 1/3 if the noise of the channels is independent to 1 if it is
/// identical.
double shared_noise(const ReferencePicture& reference) {
  double trace_of_square = 0, square_of_trace = 0;
  for (std::size_t i = 0; i < reference.covariance.size(); ++i) {
    const auto [squared_error, covariance] = noise_of(reference, i);
    const double trace = kReplicates * squared_error;
    trace_of_square += covariance * covariance;
    square_of_trace += trace * trace;
  }
  // For a covariance matrix S with ν degrees of freedom, E (tr S)² = (tr Σ)² + 2 tr Σ² / ν.
  square_of_trace -= 2.0 / (kReplicates - 1) * trace_of_square;
  if (!(square_of_trace > trace_of_square)) return 1;
  return std::max(trace_of_square / square_of_trace, 1.0 / 3);
}

bool is_all_black(const Picture& picture) {
  return std::ranges::all_of(picture.pixels,
                             [](const LinearRgb& pixel) { return is_black(pixel); });
}

}  // namespace

ReferencePicture reference_picture(RenderResult&& result) {
  ReferencePicture reference{.picture = std::move(result.picture)};
  for (LinearRgb& pixel : reference.picture.pixels) {
    pixel = {to_float(pixel.r), to_float(pixel.g), to_float(pixel.b)};
  }
  for (const PixelSpread& spread : result.spreads) {
    reference.noise.push_back(to_float(std::sqrt(spread.squared_error)));
    reference.covariance.push_back(to_float(std::sqrt(spread.covariance)));
  }
  return reference;
}

double mean_radiance(const Picture& picture) {
  double sum = 0;
  for (const LinearRgb& pixel : picture.pixels) sum += (pixel.r + pixel.g + pixel.b) / 3;
  return sum / static_cast<double>(picture.pixels.size());
}

Measured error_against(const Picture& picture, const ReferencePicture& reference) {
  const double mean = mean_radiance(reference.picture);
  if (mean == 0) {
    if (is_all_black(picture)) return {};
    return {INFINITY, {INFINITY, INFINITY}};
  }
  const double shared = shared_noise(reference);
  double sum = 0;
  PooledVariance variance;
  for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
    const auto [noise, covariance] = noise_of(reference, i);
    const double square = squared_distance(picture.pixels[i], reference.picture.pixels[i]) - noise;
    sum += square;
    variance.add(covariance * covariance / 6 + 4 * shared * std::max(square, 0.0) * noise);
  }
  const double half_width = variance.half_width();
  const double values = 3 * static_cast<double>(picture.pixels.size());
  const auto relative = [&](double squares) {
    return std::sqrt(std::max(squares, 0.0) / values) / mean;
  };
  return {relative(sum), {relative(sum - half_width), relative(sum + half_width)}};
}

double error_spread(const Picture& picture, const ReferencePicture& reference) {
  if (mean_radiance(reference.picture) == 0) return 0;
  double sum = 0, squares = 0;
  for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
    const double square = squared_distance(picture.pixels[i], reference.picture.pixels[i]) -
                          noise_of(reference, i).squared_error;
    sum += square;
    squares += square * square;
  }
  if (!(sum > 0)) return 0;
  // Half the relative deviation of the square.
  return error_against(picture, reference).value * std::sqrt(2.0 / 3 * squares) / (2 * sum);
}

}  // namespace sdlc::render
