#include "render/compare/z_test.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace sdlc::render {
namespace {

/// `sum` divided by the root of `variance`; without variance, ±infinity or 0.
double z_of(double sum, double variance) noexcept {
  return sum == 0 ? 0 : sum / std::sqrt(variance);
}

/// P(Z > z) for a standard normal Z.
double upper_tail(double z) noexcept { return 0.5 * std::erfc(z / std::numbers::sqrt2); }

double sum_of(LinearRgb c) noexcept { return c.r + c.g + c.b; }

}  // namespace

double ZTest::largest() const noexcept {
  return std::max({std::abs(mean_z.r), std::abs(mean_z.g), std::abs(mean_z.b), noise_z});
}

ZTest z_test(const NoisyPicture& a, const NoisyPicture& b) {
  LinearRgb sum, variance_sum;
  double excess_sum = 0, excess_squares = 0;
  for (std::size_t i = 0; i < a.mean.pixels.size(); ++i) {
    const LinearRgb difference = a.mean.pixels[i] - b.mean.pixels[i];
    const LinearRgb variance = a.variance.pixels[i] + b.variance.pixels[i];
    sum += difference;
    variance_sum += variance;
    const double excess = sum_of(difference * difference - variance);
    excess_sum += excess;
    excess_squares += excess * excess;
  }
  ZTest test{.mean_z = {z_of(sum.r, variance_sum.r), z_of(sum.g, variance_sum.g),
                        z_of(sum.b, variance_sum.b)},
             .noise_z = z_of(excess_sum, excess_squares)};
  const double z =
      std::max({std::abs(test.mean_z.r), std::abs(test.mean_z.g), std::abs(test.mean_z.b)});
  test.mean_p = std::min(1.0, 3 * 2 * upper_tail(z));
  test.noise_p = upper_tail(test.noise_z);
  return test;
}

}  // namespace sdlc::render
