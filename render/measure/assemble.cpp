#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "render/measure/noise_of_time.hpp"
#include "render/measure/study.hpp"
#include "render/measure/trade.hpp"
#include "render/parallel/threads.hpp"

namespace sdlc::render {
namespace {

double share(double part, double whole) { return whole > 0 ? part / whole : 0; }

std::vector<Point> points_of(const StudyLedger& ledger) {
  std::vector<Point> points = ledger.points;
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
      cut.push_back(here->cut_paths);
      seconds += here->seconds;
      own_seconds += usual->seconds;
    }
    if (lost.size() < 2) return {};
    losses.push_back({.depth = depth,
                      .loss = mean_of(lost),
                      .relative_seconds = share(seconds, own_seconds),
                      .cut_paths = mean_of(cut).value});
  }
  return losses;
}

std::optional<PrecisionDifference> precision_of(const StudyLedger& ledger) {
  const Configuration& own = ledger.plan->costs.front().configuration;
  const ConfigurationCost* const other = ledger.plan->other_precision();
  if (other == nullptr) return std::nullopt;
  PrecisionDifference difference{.taken = own.precision,
                                 .other = other->configuration.precision,
                                 .bound = ledger.precision_bound};
  if (!other->refusal.empty()) {
    difference.refusal = other->refusal;
    return difference;
  }
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
  difference.relative_seconds = share(other_seconds, seconds);
  return difference;
}

std::vector<ThreadScaling> thread_scaling_of(const StudyLedger& ledger) {
  std::vector<std::vector<double>> timings;
  for (const int threads : ledger.plan->thread_counts) {
    std::vector<double>& of_count = timings.emplace_back();
    for (const ThreadProbe& probe : ledger.threads) {
      if (probe.threads == threads) of_count.push_back(probe.seconds);
    }
    if (of_count.empty()) return {};
  }
  const NoiseOfTime noise(timings);
  std::vector<ThreadScaling> scaling;
  for (std::size_t i = 0; i < timings.size(); ++i) {
    // Rounds are complete, so that those of one round can be compared.
    std::vector<double> logarithms;
    for (std::size_t round = 0; round < timings[i].size(); ++round) {
      logarithms.push_back(std::log(timings[0][round] / timings[i][round]));
    }
    const auto [speed_up, interval] = mean_of(logarithms);
    scaling.push_back(
        {.threads = ledger.plan->thread_counts[i],
         .seconds = noise.typical(timings[i]),
         .speed_up = {std::exp(speed_up), {std::exp(interval.from), std::exp(interval.to)}}});
  }
  return scaling;
}

/// The planned points that are missing, and the configurations that cannot be rendered.
std::vector<LeftOut> left_out_of(const StudyLedger& ledger, const std::vector<Point>& points,
                                 int own_samples) {
  std::vector<LeftOut> left_out;
  for (const ConfigurationCost& cost : ledger.plan->costs) {
    if (!cost.refusal.empty()) left_out.push_back({cost.configuration, {}, cost.refusal});
  }
  const auto add = [&](const StudyTask& task) {
    if (find_point(points, task.configuration, task.samples) != nullptr) return;
    left_out.push_back({task.configuration, task.samples, "there was no time left"});
  };
  for (const StudyTask& task : ledger.plan->tasks) {
    if (task.kind == StudyTask::Kind::Point) add(task);
  }
  const StudyTask as_it_is{.configuration = ledger.plan->costs.front().configuration,
                           .samples = own_samples};
  if (!std::ranges::count(ledger.plan->tasks, as_it_is)) add(as_it_is);
  return left_out;
}

/// Shows first the recommendation for the requested error; otherwise the one nearest to 1 %,
/// preferring measured points.
void mark_main(std::vector<Recommendation>& all, std::optional<double> goal) {
  constexpr double kUsual = 0.01;
  const double wanted = goal.value_or(kUsual);
  const auto distance = [&](const Recommendation& recommendation) {
    return std::pair(!goal && !recommendation.is_measured,
                     std::abs(std::log(recommendation.goal.value_or(0) / wanted)));
  };
  const auto best = std::ranges::min_element(all, {}, distance);
  if (best != all.end()) best->is_main = true;
}

/// Scales the figures of a measured render to the scene's own size, including reading and writing.
/// Only the tracing time depends on the size.
void scale_to_full_size(Recommendation& recommendation, const StudyLedger& ledger,
                        const RenderSettings& settings) {
  const double area = static_cast<double>(settings.width) * settings.height /
                      (static_cast<double>(ledger.plan->width) * ledger.plan->height);
  const double building = ledger.plan->cost_of(recommendation.configuration).build_seconds;
  const auto [seconds, interval] = recommendation.seconds;
  const double tracing = std::max(seconds - building, 0.0) * area + building;
  // The time to load the picture codec is known only to within 50 %.
  constexpr double kOfOther = 1.5;
  const double other = ledger.other_seconds;
  recommendation.seconds = {tracing + other,
                            {tracing * interval.from / seconds + other / kOfOther,
                             tracing * interval.to / seconds + other * kOfOther}};
  recommendation.is_measured = recommendation.is_measured && area == 1;
}

Recommendation recommendation_of(const Point& point, const NoiseOfTime& noise) {
  return {.configuration = point.configuration,
          .samples = point.samples,
          .is_measured = true,
          .relative_error = point.error,
          .seconds = noise.next(point.seconds.value, point.timings.size())};
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
  if (!all.empty()) return all;
  // For a picture without noise any number of samples is enough, so recommend the fewest.
  const auto noiseless = std::ranges::find_if(points, [&](const Point& point) {
    return point.configuration == measurement.own && point.error.interval.to == 0;
  });
  if (noiseless != points.end()) all.push_back(recommendation_of(*noiseless, noise));
  return all;
}

}  // namespace

Measurement measurement_of(const StudyLedger& ledger, const RenderSettings& settings,
                           const StudyOptions& options) {
  Measurement measurement{.full_width = settings.width,
                          .full_height = settings.height,
                          .samples = settings.samples,
                          .seed = settings.seed,
                          .threads = thread_count(settings.threads),
                          .budget_seconds = options.budget_seconds,
                          .spent_seconds = ledger.spent_seconds,
                          .other_seconds = ledger.other_seconds,
                          .reference = ledger.reference,
                          .light_choice = ledger.light_choice,
                          .goal = options.goal,
                          .nonfinite_samples = ledger.nonfinite_samples};
  if (!ledger.plan) return measurement;
  measurement.own = ledger.plan->costs.front().configuration;
  measurement.width = ledger.plan->width;
  measurement.height = ledger.plan->height;
  measurement.points = points_of(ledger);
  std::vector<Point>& points = measurement.points;
  const NoiseOfTime noise = noise_of(points);
  const double pixels = static_cast<double>(measurement.width) * measurement.height;
  for (Point& point : points) {
    point.seconds = noise.typical(point.timings);
    point.samples_per_second = pixels * point.samples / point.seconds.value;
    point.rays_per_second = static_cast<double>(point.rays) / point.seconds.value;
  }
  mark_dominance(points);
  measurement.series = group_by_configuration(points);
  measurement.depths = losses_of(ledger, measurement.own.depth);
  measurement.depths_have_converged = depths_have_converged(ledger.depths);
  measurement.precision = precision_of(ledger);
  measurement.thread_scaling = thread_scaling_of(ledger);
  measurement.thread_pictures_are_same = std::ranges::all_of(ledger.threads, &ThreadProbe::is_same);
  for (const StudyTask& task : ledger.plan->tasks) {
    if (task.kind == StudyTask::Kind::Threads) measurement.thread_scaling_samples = task.samples;
  }
  measurement.left_out = left_out_of(ledger, points, settings.samples);

  if (const Point* own = find_point(points, measurement.own, settings.samples)) {
    measurement.as_it_is = recommendation_of(*own, noise);
    scale_to_full_size(*measurement.as_it_is, ledger, settings);
  }
  measurement.recommendations = recommendations_of(measurement, noise);
  mark_main(measurement.recommendations, options.goal);
  for (Recommendation& recommendation : measurement.recommendations) {
    scale_to_full_size(recommendation, ledger, settings);
  }
  return measurement;
}

}  // namespace sdlc::render
