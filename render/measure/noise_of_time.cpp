#include "render/measure/noise_of_time.hpp"

#include <algorithm>
#include <cmath>

#include "render/session/student_t.hpp"

namespace sdlc::render {
namespace {

// For an otherwise idle machine; without repetitions, the usual noise of a shared machine is
// assumed.
constexpr double kMinSigma = 0.01, kUsualSigma = 0.05;
constexpr double kUsualDegrees = 3;

double median(std::vector<double> values) {
  std::ranges::sort(values);
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

}  // namespace

Measured mean_of(std::span<const double> values) {
  const auto n = static_cast<double>(values.size());
  double mean = 0, squares = 0;
  for (const double value : values) mean += value / n;
  for (const double value : values) squares += (value - mean) * (value - mean);
  const double half_width =
      values.size() < 2 ? INFINITY : student_t_975(n - 1) * std::sqrt(squares / (n - 1) / n);
  return {mean, {mean - half_width, mean + half_width}};
}

NoiseOfTime::NoiseOfTime(std::span<const std::vector<double>> timings) {
  double squares = 0;
  for (const std::vector<double>& repeats : timings) {
    if (repeats.size() < 2) continue;
    double mean = 0;
    for (const double seconds : repeats) mean += std::log(seconds);
    mean /= static_cast<double>(repeats.size());
    for (const double seconds : repeats) squares += std::pow(std::log(seconds) - mean, 2);
    degrees_ += static_cast<double>(repeats.size() - 1);
  }
  sigma_ = degrees_ > 0 ? std::max(std::sqrt(squares / degrees_), kMinSigma) : kUsualSigma;
  degrees_ = std::max(degrees_, kUsualDegrees);
}

Measured NoiseOfTime::around(double seconds, double standard_errors) const {
  const double factor = std::exp(student_t_975(degrees_) * sigma_ * standard_errors);
  return {seconds, {seconds / factor, seconds * factor}};
}

Measured NoiseOfTime::typical(std::vector<double> timings) const {
  const auto repeats = static_cast<double>(timings.size());
  // The median of three values has 1.35 times the variance of their mean; for more values, up to
  // π/2.
  const double of_median = timings.size() > 2 ? std::sqrt(1.35) : 1;
  return around(median(std::move(timings)), of_median / std::sqrt(repeats));
}

Measured NoiseOfTime::next(double seconds, std::size_t repeats) const {
  return around(seconds, std::sqrt(1 + 1 / static_cast<double>(std::max<std::size_t>(repeats, 1))));
}

}  // namespace sdlc::render
