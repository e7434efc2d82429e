#include "render/measure/trade.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "render/session/student_t.hpp"

namespace sdlc::render {
namespace {

/// Least-squares line y = level + slope (x − center), for logarithms.
struct Line {
  double center = 0, level = 0, slope = 0;
  double spread = 0;  ///< Σ (x − center)²
  double sigma = 0;   ///< standard deviation of y about the line
  double points = 0;
  double degrees = 0;  ///< degrees of freedom of sigma

  double at(double x) const { return level + slope * (x - center); }
  /// Half the length of the 95 % intervals for the slope, and for one more y at x.
  double slope_half_width() const { return student_t_975(degrees) * sigma / std::sqrt(spread); }
  double half_width(double x) const {
    const double d = x - center;
    return student_t_975(degrees) * sigma * std::sqrt(1 + 1 / points + d * d / spread);
  }
};

/// nullopt for fewer than two points with an error above 0. Two points have no scatter about their
/// line; their sigma comes from their confidence intervals and the step-wise convergence of Sobol'
/// points.
std::optional<Line> fit_line(const Series& series, std::span<const Point> points) {
  constexpr double kSigmaOfSteps = 0.1;
  std::vector<std::array<double, 2>> logs;
  double sigma_of_two = kSigmaOfSteps;
  for (const std::size_t i : series.points) {
    const Measured& error = points[i].error;
    if (!(error.value > 0) || !std::isfinite(error.value)) continue;
    logs.push_back({std::log(points[i].samples), std::log(error.value)});
    sigma_of_two =
        std::max(sigma_of_two, std::log(error.interval.to / error.value) / student_t_975(INFINITY));
  }
  if (logs.size() < 2) return std::nullopt;
  const auto n = static_cast<double>(logs.size());
  Line line;
  for (const auto& [x, y] : logs) line.center += x / n, line.level += y / n;
  double products = 0;
  for (const auto& [x, y] : logs) {
    line.spread += (x - line.center) * (x - line.center);
    products += (x - line.center) * (y - line.level);
  }
  line.slope = products / line.spread;
  double squares = 0;
  for (const auto& [x, y] : logs) squares += std::pow(y - line.at(x), 2);
  line.points = n;
  line.degrees = n > 2 ? n - 2 : INFINITY;
  line.sigma = n > 2 ? std::sqrt(squares / line.degrees) : sigma_of_two;
  return line;
}

/// The smallest number of the form 2^k · m, m = 4 … 7, that is at least `samples`: Sobol' points
/// are evenly distributed for whole quarters of powers of two, and such numbers have few digits.
int round_up(double samples) {
  int step = 1;
  while (7.0 * step < samples) step *= 2;
  return static_cast<int>(std::ceil(samples / step)) * step;
}

/// Interpolation between two points: linear in logarithms for the error, linear in samples for the
/// seconds.
struct Between {
  const Point& a;
  const Point& b;

  double share(double samples) const {
    return std::log(samples / a.samples) / std::log(static_cast<double>(b.samples) / a.samples);
  }
  double error(double samples, double at_a, double at_b) const {
    // Lower ends, and errors below the reference's noise, may be 0.
    if (!(at_a > 0) || !(at_b > 0)) return at_a + (at_b - at_a) * share(samples);
    return at_a * std::pow(at_b / at_a, share(samples));
  }
  /// Where the upper end of the interval reaches `goal`.
  double samples_at(double goal) const {
    const double t =
        std::log(goal / a.error.interval.to) / std::log(b.error.interval.to / a.error.interval.to);
    return a.samples * std::pow(static_cast<double>(b.samples) / a.samples, t);
  }
};

double seconds_at(double samples, const Point& a, const Point& b) {
  const double rate = (b.seconds.value - a.seconds.value) / (b.samples - a.samples);
  if (!(rate > 0)) return b.seconds.value * samples / b.samples;
  return std::max(a.seconds.value + rate * (samples - a.samples), 0.0);
}

SamplesForError measured_at(std::size_t index, const Point& point) {
  return {.samples = point.samples,
          .is_measured = true,
          .point = index,
          .error = point.error,
          .seconds = point.seconds.value};
}

std::optional<SamplesForError> beyond_last(double goal, const Series& series,
                                           std::span<const Point> points) {
  const std::optional<Line> line = fit_line(series, points);
  if (!line || !(line->slope < -0.1)) return std::nullopt;
  const Point& last = points[series.points.back()];
  // Extrapolate from the last point with the slope of the series.
  constexpr double kMaxFactor = 64;
  const auto error_at = [&](double samples) {
    const double x = std::log(samples), growth = x - std::log(last.samples);
    const double value = last.error.value * std::exp(line->slope * growth);
    const double factor = std::exp(line->half_width(x));
    return Measured{value, {value / factor, value * factor}};
  };
  for (double samples = round_up(last.samples + 1); samples <= kMaxFactor * last.samples;
       samples = round_up(samples + 1)) {
    const Measured error = error_at(samples);
    if (error.interval.to > goal) continue;
    const Point& first = points[series.points.front()];
    return SamplesForError{.samples = static_cast<int>(samples),
                           .point = series.points.back(),
                           .error = error,
                           .seconds = seconds_at(samples, first, last)};
  }
  return std::nullopt;
}

/// The dominance of `point` if only it and `other` existed.
Dominance dominance_by(const Point& other, const Point& point) {
  const double quicker = point.seconds.value - other.seconds.value;
  const double nearer = point.error.value - other.error.value;
  const bool is_clearly_quicker = other.seconds.interval.to < point.seconds.interval.from;
  const bool is_clearly_nearer = other.error.interval.to < point.error.interval.from;
  // Equal errors, as of one picture rendered with two configurations, are not uncertain.
  if (is_clearly_quicker && (is_clearly_nearer || nearer == 0)) return Dominance::Dominated;
  const bool is_ahead = quicker >= 0 && nearer >= 0 && (quicker > 0 || nearer > 0);
  const bool may_be_ahead =
      is_clearly_quicker && other.error.interval.from < point.error.interval.to;
  return is_ahead || may_be_ahead ? Dominance::NotDistinguished : Dominance::Front;
}

}  // namespace

void mark_dominance(std::span<Point> points) {
  for (Point& point : points) {
    point.dominance = Dominance::Front;
    for (const Point& other : points) {
      if (&other != &point) point.dominance = std::max(point.dominance, dominance_by(other, point));
    }
  }
}

std::vector<Series> group_by_configuration(std::span<const Point> points) {
  std::vector<Series> all;
  for (std::size_t i = 0; i < points.size(); ++i) {
    auto series = std::ranges::find(all, points[i].configuration, &Series::configuration);
    if (series == all.end())
      series = all.insert(all.end(), Series{.configuration = points[i].configuration});
    series->points.push_back(i);
  }
  for (Series& series : all) {
    std::ranges::sort(series.points, {}, [&](std::size_t i) { return points[i].samples; });
    if (const std::optional<Line> line = fit_line(series, points)) {
      const double half_width = line->slope_half_width();
      series.slope = Measured{line->slope, {line->slope - half_width, line->slope + half_width}};
    }
  }
  return all;
}

std::optional<SamplesForError> samples_for(double goal, const Series& series,
                                           std::span<const Point> points) {
  const auto is_there = [&](std::size_t i) { return points[i].error.interval.to <= goal; };
  const auto found = std::ranges::find_if(series.points, is_there);
  if (found == series.points.end()) return beyond_last(goal, series, points);
  const Point& b = points[*found];
  const bool is_noiseless = !(b.error.interval.to > 0);
  if (found == series.points.begin() || is_noiseless) return measured_at(*found, b);
  const Point& a = points[*(found - 1)];
  const Between between{a, b};
  const int samples = round_up(between.samples_at(goal));
  if (samples >= b.samples) return measured_at(*found, b);
  const auto at = [&](double of_a, double of_b) { return between.error(samples, of_a, of_b); };
  return SamplesForError{.samples = samples,
                         .point = *found,
                         .error = {at(a.error.value, b.error.value),
                                   {at(a.error.interval.from, b.error.interval.from),
                                    at(a.error.interval.to, b.error.interval.to)}},
                         .seconds = seconds_at(samples, a, b)};
}

std::vector<double> worthwhile_goals(std::span<const Point> points, std::optional<double> wanted) {
  constexpr std::array kRound{0.2, 0.1, 0.05, 0.02, 0.01, 0.005, 0.002, 0.001};
  double largest = 0, smallest = 1e300;
  for (const Point& point : points) {
    if (!(point.error.interval.to > 0) || !std::isfinite(point.error.interval.to)) continue;
    largest = std::max(largest, point.error.interval.to);
    smallest = std::min(smallest, point.error.interval.to);
  }
  std::vector<double> goals;
  for (const double goal : kRound) {
    // One goal beyond the points is useful to those who have more time.
    constexpr double kBeyond = 2.5;
    if (goal <= largest && goal * kBeyond >= smallest) goals.push_back(goal);
  }
  if (wanted && !std::ranges::count(goals, *wanted)) goals.push_back(*wanted);
  std::ranges::sort(goals, std::greater());
  return goals;
}

std::optional<Recommendation> recommend(double goal, std::span<const Series> series,
                                        std::span<const Point> points, const NoiseOfTime& noise) {
  std::optional<SamplesForError> best;
  const Series* of_best = nullptr;
  for (const Series& candidate : series) {
    if (candidate.configuration.depth != series.front().configuration.depth) continue;
    std::optional<SamplesForError> found = samples_for(goal, candidate, points);
    if (!found) continue;
    // Others have to be faster than the first by more than the noise of times.
    const double kept = of_best == &series.front() ? std::exp(-2 * noise.sigma()) : 1;
    if (best && !(found->seconds < kept * best->seconds)) continue;
    best = found;
    of_best = &candidate;
  }
  if (!best) return std::nullopt;
  return Recommendation{.goal = goal,
                        .configuration = of_best->configuration,
                        .samples = best->samples,
                        .is_measured = best->is_measured,
                        .relative_error = best->error,
                        .seconds = noise.next(best->seconds, points[best->point].timings.size())};
}

}  // namespace sdlc::render
