#include "render/accuracy/adaptive_samples.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace sdlc::render {
namespace {

/// Squared errors of pixels, each the mean over its neighbours; of a lone pixel its own.
std::vector<double> of_neighbours(std::span<const PixelSpread> spreads, int width) {
  const auto columns = static_cast<std::ptrdiff_t>(width);
  const auto rows = static_cast<std::ptrdiff_t>(spreads.size()) / columns;
  std::vector<double> means;
  means.reserve(spreads.size());
  for (std::ptrdiff_t y = 0; y < rows; ++y) {
    for (std::ptrdiff_t x = 0; x < columns; ++x) {
      double sum = 0;
      int count = 0;
      for (std::ptrdiff_t v = std::max<std::ptrdiff_t>(y - 1, 0); v < std::min(y + 2, rows); ++v) {
        for (std::ptrdiff_t u = std::max<std::ptrdiff_t>(x - 1, 0); u < std::min(x + 2, columns);
             ++u) {
          if (u == x && v == y) continue;
          sum += spreads[static_cast<std::size_t>(v * columns + u)].squared_error;
          ++count;
        }
      }
      means.push_back(count > 0 ? sum / count : spreads.front().squared_error);
    }
  }
  return means;
}

}  // namespace

std::vector<std::uint32_t> adaptive_samples(std::span<const PixelSpread> pilot,
                                            const ErrorEstimate& estimate, int width, double error,
                                            SamplerKind sampler, std::uint32_t pilot_samples,
                                            std::uint64_t most_samples) {
  // The exponent of Sobol' points on scenes with edges and several bounces.
  const double b = sampler == SamplerKind::Sobol ? 1.15 : 1;
  const std::vector<double> variances = of_neighbours(pilot, width);
  const double root = error * estimate.mean;
  const double goal = root * root * 3 * static_cast<double>(pilot.size());

  // n / pilot = max(1, k · v^(1 / (1 + b))): the left side of Σ v (n / pilot)^−b = goal falls with
  // k.
  std::vector<double> shares(variances.size());
  std::ranges::transform(variances, shares.begin(),
                         [&](double v) { return std::pow(v, 1 / (1 + b)); });
  const double most = static_cast<double>(most_samples) / pilot_samples;
  const auto growth = [&](std::size_t i, double k) {
    return std::clamp(k * shares[i], 1.0, std::max(1.0, most));
  };
  const auto left = [&](double k) {
    double sum = 0;
    for (std::size_t i = 0; i < shares.size(); ++i) {
      sum += variances[i] * std::pow(growth(i, k), -b);
    }
    return sum;
  };
  const double largest = *std::ranges::max_element(shares);
  double low = 0, high = largest > 0 ? most / largest : 0;
  for (int i = 0; i < 8 && left(high) > goal; ++i) high *= 16;
  for (int i = 0; i < 40; ++i) {
    const double middle = low + (high - low) / 2;
    (left(middle) > goal ? low : high) = middle;
  }
  std::vector<std::uint32_t> samples;
  samples.reserve(shares.size());
  for (std::size_t i = 0; i < shares.size(); ++i) {
    const double wanted = growth(i, high) * pilot_samples / kReplicates;
    samples.push_back(static_cast<std::uint32_t>(std::ceil(wanted)) * kReplicates);
  }
  return samples;
}

}  // namespace sdlc::render
