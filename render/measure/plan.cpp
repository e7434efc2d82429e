#include "render/measure/plan.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include <fmt/format.h>

#include "render/film/film.hpp"

namespace sdlc::render {
namespace {

constexpr int kFirstSamples = static_cast<int>(kMinReplicatedSamples);
constexpr int kMinLadderEnd = 64, kMaxLadderEnd = 1 << 16;
/// Seconds per pixel to compare a picture with the reference, mostly for FLIP, and to extract
/// details.
constexpr double kComparingSeconds = 1.5e-6;
/// The share of the budget that is planned; the rest covers errors of the predictions, and
/// recommended renders.
constexpr double kPlannedShare = 0.85;

/// The share of the budget for renders with different numbers of threads.
constexpr double kThreadsShare = 0.2;

/// 2, 4, 8, … up to twice the scene's own depth, plus that depth.
std::vector<int> depths_around(int own) {
  constexpr int kMaxDepth = 128;
  std::vector<int> depths;
  for (int depth = 2; depth <= std::min(2 * own, kMaxDepth); depth *= 2) depths.push_back(depth);
  depths.push_back(own);
  std::ranges::sort(depths);
  depths.erase(std::ranges::unique(depths).begin(), depths.end());
  return depths;
}

/// How much is rendered. A plan counts a build for every render, although renders of the same
/// configuration share one: for a million spheres it takes longer than tracing a small picture.
enum class Extent : std::uint8_t {
  Full,
  Reduced,  ///< two points of the scene's own configuration, one of each other
  Minimal,  ///< only the scene's own configuration
};

/// Builds the plan whose ladder for the own configuration ends at `max_samples`, whatever its cost.
class PlanBuilder {
 public:
  PlanBuilder(const StudyRequest& request, Extent extent, int width, int height, int max_samples)
      : settings_(request.settings), extent_(extent), max_samples_(max_samples) {
    plan_.width = width;
    plan_.height = height;
    plan_.costs = request.costs;
    plan_.reference_configuration = request.reference_configuration;
    plan_.reference_samples = 4 * max_samples;
    plan_.depths = depths_around(request.settings.depth);
    plan_.probe_samples = std::max(kFirstSamples, max_samples / 32);
    repeat_below_ = request.budget_seconds / 60;
  }

  StudyPlan build() {
    const Configuration own = plan_.costs.front().configuration;
    plan_.tasks.push_back({.kind = StudyTask::Kind::Reference,
                           .configuration = plan_.reference_configuration,
                           .samples = plan_.reference_samples});
    const int step = extent_ == Extent::Full ? 2 : 4;
    for (int samples = max_samples_; samples >= kFirstSamples; samples /= step)
      add_point(own, samples);
    std::ranges::reverse(plan_.tasks.begin() + 1, plan_.tasks.end());
    // The scene's current settings come first.
    if (settings_.samples <= 4 * max_samples_) add_point(own, settings_.samples);
    if (extent_ == Extent::Minimal) return std::move(plan_);
    for (const ConfigurationCost& cost : plan_.costs) {
      if (cost.configuration == own || !cost.refusal.empty()) continue;
      add_others(cost.configuration, own);
    }
    if (extent_ == Extent::Reduced) return std::move(plan_);
    for (int seed = 0; seed < kProbeSeeds; ++seed) {
      plan_.tasks.push_back(
          {.kind = StudyTask::Kind::Depths, .samples = plan_.probe_samples, .round = seed});
      if (has_other_precision()) {
        plan_.tasks.push_back(
            {.kind = StudyTask::Kind::Precisions, .samples = plan_.probe_samples, .round = seed});
      }
    }
    add_repeats();
    return std::move(plan_);
  }

 private:
  void add_point(const Configuration& configuration, int samples) {
    const StudyTask task{.configuration = configuration, .samples = samples};
    if (std::ranges::count(plan_.tasks, task) == 0) plan_.tasks.push_back(task);
  }

  void add_others(const Configuration& configuration, const Configuration& own) {
    // If only the depth differs, its bias dominates, whatever the samples.
    if (configuration.depth != own.depth || extent_ == Extent::Reduced)
      return add_point(configuration, std::min(max_samples_, kMinLadderEnd));
    // Another precision has nearly the same error; only its time matters.
    const bool is_whole = configuration.precision == own.precision;
    const int last = is_whole ? max_samples_ : max_samples_ / 4;
    int samples = 2 * kFirstSamples;
    for (; samples <= last; samples *= 4) add_point(configuration, samples);
    if (is_whole && samples != 4 * last) add_point(configuration, last);
  }

  bool has_other_precision() const {
    const ConfigurationCost* const other = plan_.other_precision();
    return other != nullptr && other->refusal.empty();
  }

  /// Several rounds over all quick points, so that repetitions are spread over the whole
  /// measurement.
  void add_repeats() {
    const std::vector<StudyTask> once = plan_.tasks;
    for (int round = 1; round <= 2; ++round) {
      for (StudyTask task : once) {
        if (task.kind != StudyTask::Kind::Point) continue;
        task.kind = StudyTask::Kind::Repeat;
        task.round = round;
        if (plan_.seconds_of(task) <= repeat_below_) plan_.tasks.push_back(task);
      }
    }
  }

  const RenderSettings& settings_;
  Extent extent_;
  int max_samples_;
  double repeat_below_ = 0;
  StudyPlan plan_;
};

double total_seconds(const StudyPlan& plan) {
  double seconds = 0;
  for (const StudyTask& task : plan.tasks) seconds += plan.seconds_of(task);
  return seconds;
}

/// Adds renders with each number of threads, first of all: with as many samples as `seconds` allow,
/// at least the fewest.
void add_threads(StudyPlan& plan, const std::vector<int>& counts, double seconds) {
  if (counts.empty()) return;
  plan.thread_counts = counts;
  StudyTask task{.kind = StudyTask::Kind::Threads,
                 .configuration = plan.costs.front().configuration,
                 .samples = kFirstSamples};
  const auto fits = [&](int samples) {
    task.samples = samples;
    return kThreadRounds * plan.seconds_of(task) <= seconds;
  };
  int samples = kFirstSamples;
  while (samples < kMaxLadderEnd && fits(2 * samples)) samples *= 2;
  task.samples = samples;
  for (int round = kThreadRounds; round-- > 0;) {
    task.round = round;
    plan.tasks.insert(plan.tasks.begin(), task);
  }
}

/// The part of the time that does not depend on the picture's size.
double building_seconds(StudyPlan plan) {
  plan.width = plan.height = 0;
  return total_seconds(plan);
}

}  // namespace

const ConfigurationCost& StudyPlan::cost_of(const Configuration& configuration) const {
  // Other depths and the reference were not tried: use a similar configuration.
  const auto found = std::ranges::find(costs, configuration, &ConfigurationCost::configuration);
  if (found != costs.end()) return *found;
  const auto near = std::ranges::find_if(costs, [&](const ConfigurationCost& cost) {
    Configuration like = cost.configuration;
    like.sampler = configuration.sampler;
    like.depth = configuration.depth;
    return like == configuration;
  });
  return near != costs.end() ? *near : costs.front();
}

const ConfigurationCost* StudyPlan::other_precision() const {
  const Configuration& own = costs.front().configuration;
  const auto found = std::ranges::find_if(costs, [&](const ConfigurationCost& cost) {
    Configuration configuration = cost.configuration;
    configuration.precision = own.precision;
    return configuration == own && cost.configuration != own;
  });
  return found == costs.end() ? nullptr : &*found;
}

double StudyPlan::seconds_of(const StudyTask& task) const {
  const double pixels = static_cast<double>(width) * height;
  const auto render = [&](const Configuration& configuration) {
    const ConfigurationCost& cost = cost_of(configuration);
    return cost.build_seconds +
           (cost.seconds_per_sample * task.samples + cost.seconds_per_pixel) * pixels;
  };
  switch (task.kind) {
    case StudyTask::Kind::Reference:
    case StudyTask::Kind::Repeat: return render(task.configuration);
    case StudyTask::Kind::Point: return render(task.configuration) + pixels * kComparingSeconds;
    case StudyTask::Kind::Depths:
      return static_cast<double>(depths.size()) * render(costs.front().configuration);
    case StudyTask::Kind::Precisions: {
      constexpr double kOther = 2;  // usual slowdown of double
      return (1 + kOther) * render(costs.front().configuration);
    }
    case StudyTask::Kind::Threads: {
      double seconds = 0;
      for (const int threads : thread_counts) {
        seconds += render(task.configuration) * thread_counts.back() / threads;
      }
      return seconds;
    }
  }
  return 0;
}

std::string describe(const StudyTask& task) {
  const auto of_configuration = [&] {
    return fmt::format("{} samples, {}", task.samples, describe(task.configuration));
  };
  switch (task.kind) {
    case StudyTask::Kind::Reference: return "reference: " + of_configuration();
    case StudyTask::Kind::Point: return of_configuration();
    case StudyTask::Kind::Repeat: return of_configuration() + ", again for its time";
    case StudyTask::Kind::Depths:
      return fmt::format("depths, {} of {}", task.round + 1, kProbeSeeds);
    case StudyTask::Kind::Precisions:
      return fmt::format("precisions, {} of {}", task.round + 1, kProbeSeeds);
    case StudyTask::Kind::Threads:
      return fmt::format("numbers of threads, {} of {}", task.round + 1, kThreadRounds);
  }
  return {};
}

std::vector<int> thread_counts_up_to(int most) {
  std::vector<int> counts;
  for (int power = 1; power < most; power *= 2) {
    counts.push_back(power);
    if (power > 1 && 3 * (power / 2) < most) counts.push_back(3 * (power / 2));
  }
  counts.push_back(most);
  return counts;
}

StudyPlan plan_study(const StudyRequest& request) {
  const double for_threads =
      request.thread_counts.empty() ? 0 : kThreadsShare * request.budget_seconds;
  const double seconds = kPlannedShare * request.budget_seconds - for_threads;
  const RenderSettings& settings = request.settings;
  Extent extent = Extent::Full;
  const auto build = [&](double scale, int max_samples) {
    const auto side = [&](int full) {
      return std::max(1, static_cast<int>(std::lround(full * scale)));
    };
    const auto [width, height] =
        request.size.value_or(std::array{side(settings.width), side(settings.height)});
    return PlanBuilder(request, extent, width, height, max_samples).build();
  };
  // Leave at least half of the time for tracing.
  while (extent != Extent::Minimal && building_seconds(build(1, kMinLadderEnd)) > seconds / 2) {
    extent = extent == Extent::Full ? Extent::Reduced : Extent::Minimal;
  }
  const double building = building_seconds(build(1, kMinLadderEnd));
  const double for_all = std::max(seconds, 2 * building);
  // Smaller pictures represent edges less well: choose the largest that the budget allows.
  double scale = 1;
  if (!request.size && total_seconds(build(1, kMinLadderEnd)) > for_all) {
    constexpr int kSteps = 20;
    double too_large = 1;
    scale = 1.0 / 64;
    for (int step = 0; step < kSteps; ++step) {
      const double mid = (scale + too_large) / 2;
      const bool fits = total_seconds(build(mid, kMinLadderEnd)) <= for_all;
      (fits ? scale : too_large) = mid;
    }
  }
  StudyPlan plan = build(scale, kMinLadderEnd);
  for (int max_samples = 2 * kMinLadderEnd; scale == 1 && max_samples <= kMaxLadderEnd;
       max_samples *= 2) {
    StudyPlan longer = build(scale, max_samples);
    if (total_seconds(longer) > seconds) break;
    plan = std::move(longer);
  }
  // Use the remaining time for a better reference.
  StudyTask& reference = plan.tasks.front();
  reference.samples *= 2;
  plan.reference_samples *= 2;
  if (total_seconds(plan) > seconds) {
    reference.samples /= 2;
    plan.reference_samples /= 2;
  }
  add_threads(plan, request.thread_counts, for_threads);
  return plan;
}

}  // namespace sdlc::render
