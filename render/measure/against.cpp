#include "render/measure/against.hpp"

#include <cmath>
#include <cstddef>
#include <utility>

#include "render/measure/noise_of_time.hpp"

namespace sdlc::render {
namespace {

constexpr double kLevel = 0.05;
constexpr double kDrift = 0.05;
constexpr double kNormalQuantile = 1.96;

/// The variance of the error of a point's pictures over seeds, plus that of its measurement.
double squared_deviation(const Measured& error, double spread) {
  const double of_interval = (error.interval.to - error.interval.from) / (2 * kNormalQuantile);
  return of_interval * of_interval + spread * spread;
}

Verdict judge_error(const Point& now, const Point& before, std::size_t tests) {
  const double difference = now.error.value - before.error.value;
  const double variance = squared_deviation(now.error, now.error_spread) +
                          squared_deviation(before.error, before.error_spread);
  if (!std::isfinite(difference)) return Verdict::NotDistinguished;
  if (difference == 0 || !(variance > 0)) {
    return difference > 0   ? Verdict::Worse
           : difference < 0 ? Verdict::Better
                            : Verdict::NotDistinguished;
  }
  const double p = std::erfc(std::abs(difference) / std::sqrt(2 * variance));
  if (p * static_cast<double>(tests) > kLevel) return Verdict::NotDistinguished;
  return difference > 0 ? Verdict::Worse : Verdict::Better;
}

/// Shorter times are dominated by starting threads.
constexpr double kMinSeconds = 0.005;

/// `sigma`: the noise of one time, from both measurements. All times of a measurement share the
/// state of the machine, so this term does not shrink with the number of points.
std::optional<Measured> mean_ratio(const std::vector<PointChange>& points, double sigma) {
  std::vector<double> ratios;
  for (const PointChange& point : points) {
    if (point.seconds_before.value < kMinSeconds) continue;
    ratios.push_back(std::log(point.seconds.value / point.seconds_before.value));
  }
  constexpr std::size_t kMinPoints = 3;
  if (ratios.size() < kMinPoints) return std::nullopt;
  const auto [mean, interval] = mean_of(ratios);
  const double half_width = std::hypot(interval.to - mean, kNormalQuantile * sigma);
  return Measured{std::exp(mean), {std::exp(mean - half_width), std::exp(mean + half_width)}};
}

double spread_of(const std::vector<Point>& points) {
  std::vector<std::vector<double>> timings;
  for (const Point& point : points) {
    if (point.seconds.value >= kMinSeconds) timings.push_back(point.timings);
  }
  return NoiseOfTime(timings).sigma();
}

}  // namespace

Comparison compare_measurements(const std::vector<Point>& now, const std::vector<Point>& before,
                                bool has_comparable_times) {
  Comparison comparison;
  std::vector<std::pair<const Point*, const Point*>> common;
  for (const Point& point : now) {
    const Point* const earlier = find_point(before, point.configuration, point.samples);
    if (earlier != nullptr) common.emplace_back(&point, earlier);
  }
  for (const auto& [after, earlier] : common) {
    comparison.points.push_back({.configuration = after->configuration,
                                 .samples = after->samples,
                                 .relative_error_before = earlier->error,
                                 .relative_error = after->error,
                                 .seconds_before = earlier->seconds,
                                 .seconds = after->seconds,
                                 .error = judge_error(*after, *earlier, common.size())});
    if (comparison.points.back().error == Verdict::Worse) ++comparison.worse_errors;
  }
  if (has_comparable_times) {
    comparison.time_ratio =
        mean_ratio(comparison.points, std::hypot(spread_of(now), spread_of(before)));
  }
  if (comparison.time_ratio) {
    const Interval& ratio = comparison.time_ratio->interval;
    if (ratio.from > 1 + kDrift) comparison.time = Verdict::Worse;
    if (ratio.to < 1 / (1 + kDrift)) comparison.time = Verdict::Better;
  }
  return comparison;
}

}  // namespace sdlc::render
