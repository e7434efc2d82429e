#include "render/session/adaptive_samples.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace sdlc::render {
namespace {

/// The expected squared error of each pixel: nine tenths of the mean over its 5 × 5 neighbourhood,
/// without the pixel itself, plus a tenth of the mean over the picture. Without the second term,
/// one pixel where a path found a light by chance would leave the pixels around it with too few
/// samples to find that light.
std::vector<double> expected_errors(std::span<const PixelSpread> spreads, int width) {
  constexpr std::ptrdiff_t kRadius = 2;
  constexpr double kShareOfAll = 0.1;
  const auto columns = static_cast<std::ptrdiff_t>(width);
  const auto rows = static_cast<std::ptrdiff_t>(spreads.size()) / columns;
  const auto error_at = [&](std::ptrdiff_t x, std::ptrdiff_t y) {
    return spreads[static_cast<std::size_t>(y * columns + x)].squared_error;
  };
  double total = 0;
  for (const PixelSpread& spread : spreads) total += spread.squared_error;
  const double of_all = total / static_cast<double>(spreads.size());

  std::vector<double> errors;
  errors.reserve(spreads.size());
  for (std::ptrdiff_t y = 0; y < rows; ++y) {
    for (std::ptrdiff_t x = 0; x < columns; ++x) {
      double sum = 0;
      int count = 0;
      for (std::ptrdiff_t v = std::max<std::ptrdiff_t>(y - kRadius, 0);
           v <= std::min(y + kRadius, rows - 1); ++v) {
        for (std::ptrdiff_t u = std::max<std::ptrdiff_t>(x - kRadius, 0);
             u <= std::min(x + kRadius, columns - 1); ++u) {
          if (u == x && v == y) continue;
          sum += error_at(u, v);
          ++count;
        }
      }
      const double nearby = count > 0 ? sum / count : of_all;
      errors.push_back((1 - kShareOfAll) * nearby + kShareOfAll * of_all);
    }
  }
  return errors;
}

}  // namespace

std::vector<std::uint32_t> adaptive_samples(std::span<const PixelSpread> pilot,
                                            const ErrorEstimate& estimate, int width, double error,
                                            SamplerKind sampler, std::uint32_t pilot_samples,
                                            std::uint64_t max_samples) {
  // The exponent measured for Sobol' points on scenes with edges and several bounces.
  const double b = sampler == SamplerKind::Sobol ? 1.15 : 1;
  const std::vector<double> variances = expected_errors(pilot, width);
  const double root = error * estimate.mean;
  const double goal = root * root * 3 * static_cast<double>(pilot.size());

  // n / pilot = max(1, k · v^(1 / (1 + b))). Bisection for k: Σ v (n / pilot)^−b falls with k and
  // has to reach `goal`.
  std::vector<double> shares(variances.size());
  std::ranges::transform(variances, shares.begin(),
                         [&](double v) { return std::pow(v, 1 / (1 + b)); });
  const double max_growth = static_cast<double>(max_samples) / pilot_samples;
  const auto growth = [&](std::size_t i, double k) {
    return std::clamp(k * shares[i], 1.0, std::max(1.0, max_growth));
  };
  const auto left = [&](double k) {
    double sum = 0;
    for (std::size_t i = 0; i < shares.size(); ++i) {
      sum += variances[i] * std::pow(growth(i, k), -b);
    }
    return sum;
  };
  const double largest = *std::ranges::max_element(shares);
  double low = 0, high = largest > 0 ? max_growth / largest : 0;
  for (int i = 0; i < 8 && left(high) > goal; ++i) high *= 16;
  for (int i = 0; i < 40; ++i) {
    const double mid = low + (high - low) / 2;
    (left(mid) > goal ? low : high) = mid;
  }
  std::vector<std::uint32_t> samples;
  samples.reserve(shares.size());
  for (std::size_t i = 0; i < shares.size(); ++i) {
    const double wanted = growth(i, high) * pilot_samples / kReplicates;
    const std::uint64_t whole = static_cast<std::uint64_t>(std::ceil(wanted)) * kReplicates;
    samples.push_back(static_cast<std::uint32_t>(std::min(whole, max_samples)));
  }
  return samples;
}

}  // namespace sdlc::render
