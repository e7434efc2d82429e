#include "tests/support/statistics/estimate.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace sdlc::test {
namespace {

std::array<double, 3> channels(render::LinearRgb c) { return {c.r, c.g, c.b}; }

}  // namespace

Estimate EstimateBuilder::estimate() const {
  const auto n = static_cast<double>(count_);
  const render::LinearRgb mean = sum_ / n;
  const auto standard_error = [&](double sum_of_squares, double m) {
    return std::sqrt(std::max(0.0, sum_of_squares / n - m * m) / (n - 1));
  };
  return {.mean = mean,
          .standard_error = {standard_error(sum_of_squares_.r, mean.r),
                             standard_error(sum_of_squares_.g, mean.g),
                             standard_error(sum_of_squares_.b, mean.b)},
          .samples = count_};
}

testing::AssertionResult agrees(const Estimate& estimate, render::LinearRgb expected,
                                double significance) {
  const auto mean = channels(estimate.mean), error = channels(estimate.standard_error),
             wanted = channels(expected);
  for (std::size_t i = 0; i < 3; ++i) {
    const double difference = mean[i] - wanted[i];
    // Rounding gives a spread of about 1e-9 in a mean of equal samples.
    const bool is_constant = error[i] < 1e-9 * std::fabs(wanted[i]) + 1e-300;
    const double z = difference / error[i];
    const double p = std::erfc(std::fabs(z) / std::sqrt(2.0));
    const double rounding = static_cast<double>(estimate.samples + 4) * 0x1p-53;
    const bool is_right = is_constant ? std::fabs(difference) <= rounding * std::fabs(wanted[i])
                                      : p >= significance / 3;
    if (is_right) continue;
    return testing::AssertionFailure()
           << "channel " << i << ": " << mean[i] << " is not " << wanted[i] << " (standard error "
           << error[i] << ", z = " << z << ", p = " << p << ", " << estimate.samples << " samples)";
  }
  return testing::AssertionSuccess();
}

testing::AssertionResult agree(const Estimate& a, const Estimate& b, double significance) {
  const render::LinearRgb variance =
      a.standard_error * a.standard_error + b.standard_error * b.standard_error;
  const Estimate difference{
      .mean = a.mean - b.mean,
      .standard_error = {std::sqrt(variance.r), std::sqrt(variance.g), std::sqrt(variance.b)},
      .samples = std::min(a.samples, b.samples)};
  return agrees(difference, render::LinearRgb{}, significance);
}

}  // namespace sdlc::test
