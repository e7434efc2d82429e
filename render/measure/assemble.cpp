#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "render/accuracy/student_t.hpp"
#include "render/measure/noise_of_time.hpp"
#include "render/measure/study.hpp"
#include "render/measure/trade.hpp"
#include "render/tiles/threads.hpp"

namespace sdlc::render {
namespace {

/// The mean of a few values with its 95 % interval, by Student's t distribution.
Measured mean_of(const std::vector<double>& values) {
  const auto n = static_cast<double>(values.size());
  double mean = 0, squares = 0;
  for (const double value : values) mean += value / n;
  for (const double value : values) squares += (value - mean) * (value - mean);
  const double half_width =
      values.size() < 2 ? INFINITY : student_t_975(n - 1) * std::sqrt(squares / (n - 1) / n);
  return {mean, {mean - half_width, mean + half_width}};
}

double share(double part, double whole) { return whole > 0 ? part / whole : 0; }

std::vector<Point> points_of(const StudyLedger& ledger) {
  std::vector<Point> points;
  for (const Evaluation& evaluation : ledger.evaluations) {
    Point point{.configuration = evaluation.configuration,
                .samples = evaluation.samples,
                .error = evaluation.error,
                .error_spread = evaluation.error_spread,
                .difference = evaluation.difference,
                .flip = evaluation.flip,
                .scarce_emitters = evaluation.scarce_emitters,
                .cut_share = evaluation.cut_share};
    for (const TimedRender& render : ledger.renders) {
      if (render.configuration != point.configuration || render.samples != point.samples) continue;
      point.timings.push_back(render.seconds);
      point.samples_per_second = static_cast<double>(render.camera_samples);
      point.rays_per_second = static_cast<double>(render.rays);
    }
    points.push_back(std::move(point));
  }
  // Points of the scene's own configuration first; per configuration in ascending order of samples.
  const auto rank = [&](const Point& point) {
    const auto& costs = ledger.plan->costs;
    return std::ranges::find(costs, point.configuration, &ConfigurationCost::configuration) -
           costs.begin();
  };
  std::ranges::stable_sort(points, [&](const Point& a, const Point& b) {
    return std::pair(rank(a), a.samples) < std::pair(rank(b), b.samples);
  });
  return points;
}

NoiseOfTime noise_of(const std::vector<Point>& points) {
  std::vector<std::vector<double>> timings;
  for (const Point& point : points) timings.push_back(point.timings);
  return NoiseOfTime(timings);
}

std::vector<DepthLoss> losses_of(const StudyLedger& ledger, int own) {
  std::vector<DepthLoss> losses;
  const int deepest = ledger.plan->depths.back();
  for (const int depth : ledger.plan->depths) {
    std::vector<double> lost, cut;
    double seconds = 0, own_seconds = 0;
    for (int round = 0; round < kProbeSeeds; ++round) {
      const auto find = [&](int of) {
        return std::ranges::find_if(ledger.depths, [&](const DepthProbe& probe) {
          return probe.depth == of && probe.round == round;
        });
      };
      const auto here = find(depth), full = find(deepest), usual = find(own);
      if (here == ledger.depths.end()) continue;
      lost.push_back(share(full->mean - here->mean, full->mean));
      cut.push_back(here->cut_share);
      seconds += here->seconds;
      own_seconds += usual->seconds;
    }
    if (lost.size() < 2) return {};
    losses.push_back({.depth = depth,
                      .loss = mean_of(lost),
                      .seconds = share(seconds, own_seconds),
                      .cut_share = mean_of(cut).value});
  }
  return losses;
}

std::optional<PrecisionDifference> precision_of(const StudyLedger& ledger) {
  const Configuration& own = ledger.plan->costs.front().configuration;
  const ConfigurationCost* const other = ledger.plan->other_precision();
  if (other == nullptr) return std::nullopt;
  PrecisionDifference difference{.taken = own.precision,
                                 .other = other->configuration.precision,
                                 .refusal = other->refusal,
                                 .bound = ledger.precision_bound};
  if (!difference.refusal.empty()) return difference;
  if (ledger.precisions.size() < 2) return std::nullopt;
  std::vector<double> differences, squares;
  double seconds = 0, other_seconds = 0;
  for (const PrecisionProbe& probe : ledger.precisions) {
    differences.push_back(share(probe.mean - probe.other_mean, probe.other_mean));
    squares.push_back(probe.rms_difference * probe.rms_difference);
    seconds += probe.seconds;
    other_seconds += probe.other_seconds;
  }
  difference.mean_difference = mean_of(differences);
  difference.rms_difference = std::sqrt(mean_of(squares).value);
  difference.seconds = share(other_seconds, seconds);
  return difference;
}

/// The points that are missing: no time was left, not planned, or impossible to render.
std::vector<LeftOut> left_out_of(const StudyLedger& ledger, const std::vector<Point>& points,
                                 int own_samples) {
  std::vector<LeftOut> left_out;
  for (const ConfigurationCost& cost : ledger.plan->costs) {
    if (!cost.refusal.empty()) left_out.push_back({cost.configuration, 0, cost.refusal});
  }
  const auto add = [&](const StudyTask& task) {
    const bool is_there = std::ranges::any_of(points, [&](const Point& point) {
      return point.configuration == task.configuration && point.samples == task.samples;
    });
    if (!is_there) left_out.push_back({task.configuration, task.samples, "there was no time left"});
  };
  for (const StudyTask& task : ledger.plan->tasks) {
    if (task.kind == StudyTask::Kind::Point) add(task);
  }
  const StudyTask as_it_is{.configuration = ledger.plan->costs.front().configuration,
                           .samples = own_samples};
  if (!std::ranges::count(ledger.plan->tasks, as_it_is)) add(as_it_is);
  return left_out;
}

/// The recommendation to show first: the one for the requested error; otherwise the one nearest to
/// 1 %, preferring measured points.
std::size_t main_of(const std::vector<Recommendation>& all, std::optional<double> goal) {
  constexpr double kUsual = 0.01;
  const double wanted = goal.value_or(kUsual);
  const auto distance = [&](const Recommendation& recommendation) {
    return std::pair(!goal && !recommendation.is_measured,
                     std::abs(std::log(recommendation.goal / wanted)));
  };
  const auto best = std::ranges::min_element(all, {}, distance);
  return static_cast<std::size_t>(best - all.begin());
}

/// Scales the figures of a measured render to the scene's own size, including reading and writing.
/// Only the tracing time depends on the size.
class FullSize {
 public:
  FullSize(const StudyLedger& ledger, const RenderSettings& settings)
      : ledger_(ledger),
        area_(static_cast<double>(settings.width) * settings.height /
              (static_cast<double>(ledger.plan->width) * ledger.plan->height)) {}

  bool is_measured() const { return area_ == 1; }

  Measured seconds(const Configuration& configuration, const Measured& measured) const {
    const double building = ledger_.plan->cost_of(configuration).build_seconds;
    const double tracing = std::max(measured.value - building, 0.0) * area_ + building;
    // The time to load the picture codec is known only to within 50 %.
    constexpr double kOfOther = 1.5;
    const double other = ledger_.other_seconds;
    return {tracing + other,
            {tracing * measured.interval.from / measured.value + other / kOfOther,
             tracing * measured.interval.to / measured.value + other * kOfOther}};
  }

 private:
  const StudyLedger& ledger_;
  double area_;
};

std::optional<Recommendation> as_it_is(const Measurement& measurement, const NoiseOfTime& noise,
                                       const FullSize& full_size) {
  for (const Point& point : measurement.points) {
    if (point.configuration != measurement.own || point.samples != measurement.own_samples)
      continue;
    return Recommendation{
        .configuration = point.configuration,
        .samples = point.samples,
        .is_measured = full_size.is_measured(),
        .error = point.error,
        .seconds = full_size.seconds(point.configuration,
                                     noise.next(point.seconds.value, point.timings.size()))};
  }
  return std::nullopt;
}

/// For a picture without noise any number of samples is enough, so recommend the fewest.
std::optional<Recommendation> without_noise(const Measurement& measurement,
                                            const NoiseOfTime& noise) {
  for (const Point& point : measurement.points) {
    if (point.configuration != measurement.own || point.error.interval.to != 0) continue;
    return Recommendation{.configuration = point.configuration,
                          .samples = point.samples,
                          .is_measured = true,
                          .error = point.error,
                          .seconds = noise.next(point.seconds.value, point.timings.size())};
  }
  return std::nullopt;
}

std::vector<Recommendation> recommendations_of(const Measurement& measurement,
                                               const NoiseOfTime& noise) {
  std::vector<Recommendation> all;
  const std::vector<Point>& points = measurement.points;
  for (const double goal : worthwhile_goals(points, measurement.goal)) {
    std::optional<Recommendation> found = recommend(goal, measurement.series, points, noise);
    if (!found) continue;
    // If one configuration is enough for both goals, report it once, for the smaller error.
    const bool is_same = !all.empty() && all.back().configuration == found->configuration &&
                         all.back().samples == found->samples &&
                         all.back().goal != measurement.goal;
    if (is_same) all.pop_back();
    all.push_back(*std::move(found));
  }
  if (all.empty()) {
    if (const auto found = without_noise(measurement, noise)) all.push_back(*found);
  }
  return all;
}

}  // namespace

Measurement measurement_of(const StudyLedger& ledger, const RenderSettings& settings,
                           const StudyOptions& options) {
  Measurement measurement{.full_width = settings.width,
                          .full_height = settings.height,
                          .own_samples = settings.samples,
                          .seed = settings.seed,
                          .threads = thread_count(settings.threads),
                          .budget_seconds = options.budget_seconds,
                          .spent_seconds = ledger.spent_seconds,
                          .other_seconds = ledger.other_seconds,
                          .reference = ledger.reference,
                          .goal = options.goal,
                          .nonfinite_samples = ledger.nonfinite_samples};
  if (!ledger.plan) return measurement;
  measurement.own = ledger.plan->costs.front().configuration;
  measurement.width = ledger.plan->width;
  measurement.height = ledger.plan->height;
  measurement.points = points_of(ledger);
  std::vector<Point>& points = measurement.points;
  const NoiseOfTime noise = noise_of(points);
  for (Point& point : points) {
    point.seconds = noise.typical(point.timings);
    point.samples_per_second /= point.seconds.value;
    point.rays_per_second /= point.seconds.value;
  }
  mark_dominance(points);
  measurement.series = group_by_configuration(points);
  measurement.depths = losses_of(ledger, measurement.own.depth);
  measurement.depths_have_converged = depths_have_converged(ledger.depths);
  measurement.precision = precision_of(ledger);
  measurement.left_out = left_out_of(ledger, points, settings.samples);

  const FullSize full_size(ledger, settings);
  measurement.as_it_is = as_it_is(measurement, noise, full_size);
  measurement.recommendations = recommendations_of(measurement, noise);
  measurement.main_recommendation = main_of(measurement.recommendations, options.goal);
  for (Recommendation& recommendation : measurement.recommendations) {
    recommendation.seconds =
        full_size.seconds(recommendation.configuration, recommendation.seconds);
    recommendation.is_measured = recommendation.is_measured && full_size.is_measured();
  }
  return measurement;
}

}  // namespace sdlc::render
