#include "render/measure/study.hpp"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/statistics/rooms.hpp"

namespace sdlc::test {
namespace {

using render::Measurement;
using render::Point;
using render::StudyLedger;
using render::StudyObserver;

constexpr render::RenderSettings kSettings{.width = 24, .height = 16, .samples = 12, .depth = 6};
/// Enough time for the whole plan of such a small picture.
constexpr render::StudyOptions kOptions{.budget_seconds = 600};

/// A ledger with a plan of so few samples that it takes about a second on any machine.
StudyLedger short_ledger() {
  StudyLedger ledger;
  render::Configuration own{.precision = render::Precision::Float, .depth = 6};
  render::StudyRequest request{.settings = kSettings,
                               .reference_configuration = own,
                               .budget_seconds = kOptions.budget_seconds};
  // So slow that 64 samples are the maximum.
  const double seconds_per_sample = 0.5;
  request.costs.push_back(
      {.configuration = own, .seconds_per_sample = seconds_per_sample / (24 * 16)});
  render::Configuration independent = own;
  independent.sampler = render::SamplerKind::Independent;
  request.costs.push_back(
      {.configuration = independent, .seconds_per_sample = seconds_per_sample / (24 * 16)});
  render::Configuration exact = own;
  exact.precision = render::Precision::Double;
  request.costs.push_back(
      {.configuration = exact, .seconds_per_sample = seconds_per_sample / (24 * 16)});
  ledger.plan = plan_study(request);
  // Without repetitions, whose number depends on timing.
  std::erase_if(ledger.plan->tasks, [](const render::StudyTask& task) {
    return task.kind == render::StudyTask::Kind::Repeat;
  });
  return ledger;
}

class StudyTest : public testing::Test {
 protected:
  /// Runs until `most` tasks are done; all by default.
  void run(StudyLedger& ledger, int most = 1 << 30) {
    render::RenderMonitor monitor;
    int done = 0;
    StudyObserver observer;
    observer.on_reference = [&](const render::ReferencePicture& picture) { reference_ = picture; };
    observer.on_progress = [&](const StudyLedger&) {
      if (++done >= most) monitor.cancel = true;
    };
    render::Study study(scene_, kSettings, {}, kOptions, ledger, observer, monitor);
    study.run(reference_);
  }

  static Point point_of(const Measurement& measurement, const render::StudyTask& task) {
    const auto found = std::ranges::find_if(measurement.points, [&](const Point& point) {
      return point.configuration == task.configuration && point.samples == task.samples;
    });
    EXPECT_NE(found, measurement.points.end()) << describe(task);
    return found != measurement.points.end() ? *found : Point{};
  }

  Measurement measurement(const StudyLedger& ledger) const {
    return measurement_of(ledger, kSettings, kOptions);
  }

  const render::Scene scene_ = small_room();
  std::optional<render::ReferencePicture> reference_;
};

TEST_F(StudyTest, MeasuresEveryPointOfItsPlan) {
  StudyLedger ledger = short_ledger();
  run(ledger);
  const Measurement result = measurement(ledger);
  ASSERT_TRUE(result.reference);
  EXPECT_TRUE(result.left_out.empty());
  ASSERT_GE(result.series.size(), 3u);
  EXPECT_EQ(result.series[0].configuration, result.own);
  for (const Point& point : result.points) {
    EXPECT_GT(point.seconds.value, 0);
    EXPECT_GT(point.error.value, 0);
    EXPECT_LE(point.error.interval.from, point.error.value);
    EXPECT_GE(point.error.interval.to, point.error.value);
    EXPECT_GT(point.flip, 0);
  }
  const auto& own = result.series[0].points;
  EXPECT_LT(result.points[own.back()].error.value, result.points[own.front()].error.value / 2);
  ASSERT_FALSE(result.recommendations.empty());
}

TEST_F(StudyTest, TellsWhatDepthsLose) {
  StudyLedger ledger = short_ledger();
  run(ledger);
  const auto depths = measurement(ledger).depths;
  ASSERT_EQ(depths.size(), ledger.plan->depths.size());
  EXPECT_GT(depths.front().loss.interval.from, 0.01)
      << "with depth 2 what bounces twice is missing";
  EXPECT_EQ(depths.back().loss.value, 0) << "the greatest is what the others are held against";
  for (std::size_t i = 1; i < depths.size(); ++i) {
    EXPECT_LE(depths[i].loss.value, depths[i - 1].loss.value);
  }
}

TEST_F(StudyTest, TimesNumbersOfThreadsOnce) {
  StudyLedger ledger = short_ledger();
  ledger.plan->thread_counts = {1, 3};
  ledger.plan->tasks.clear();
  for (int round = 0; round < render::kThreadRounds; ++round) {
    ledger.plan->tasks.push_back({.kind = render::StudyTask::Kind::Threads,
                                  .configuration = ledger.plan->costs.front().configuration,
                                  .samples = 8,
                                  .round = round});
  }
  run(ledger, 2);
  EXPECT_EQ(ledger.threads.size(), 2u * 2);
  run(ledger);
  EXPECT_EQ(ledger.threads.size(), 2u * render::kThreadRounds);
  EXPECT_EQ(ledger.threads[0].threads, 1);
  EXPECT_EQ(ledger.threads[2].threads, 3) << "every second round begins with the most";
  const Measurement result = measurement(ledger);
  EXPECT_TRUE(result.thread_pictures_are_same);
  EXPECT_EQ(result.thread_scaling_samples, 8);
  ASSERT_EQ(result.thread_scaling.size(), 2u);
  EXPECT_EQ(result.thread_scaling[0].speed_up.value, 1);
  const render::ThreadScaling& three = result.thread_scaling[1];
  EXPECT_EQ(three.threads, 3);
  EXPECT_GT(three.seconds.value, 0);
  EXPECT_LT(three.speed_up.interval.from, three.speed_up.value);
  ledger.threads[3].is_same = false;
  EXPECT_FALSE(measurement(ledger).thread_pictures_are_same);
}

/// Of a round, with its radiance at each depth.
std::vector<render::DepthProbe> probes(std::vector<std::pair<int, double>> means, double cut) {
  std::vector<render::DepthProbe> all;
  for (const auto& [depth, mean] : means) {
    all.push_back({.depth = depth, .mean = mean, .cut_paths = cut});
  }
  return all;
}

TEST(DepthProbes, HaveConvergedWhereTwiceTheDepthAddsNothing) {
  EXPECT_FALSE(render::depths_have_converged({}));
  EXPECT_FALSE(render::depths_have_converged(probes({{2, 0.5}, {4, 0.8}, {8, 0.9}}, 0.001)));
  EXPECT_TRUE(render::depths_have_converged(probes({{2, 0.5}, {4, 0.9}, {8, 0.9}}, 0.001)));
  EXPECT_TRUE(render::depths_have_converged(probes({{2, 0.5}, {4, 0.9}}, 0))) << "no path is cut";
  EXPECT_FALSE(render::depths_have_converged(probes({{4, 0.8}, {7, 0.9}, {8, 0.9}}, 0.001)))
      << "8 is not twice 7";
  EXPECT_FALSE(render::depths_have_converged(probes({{2, 0.5}, {4, 0.9}, {8, 0.9}, {16, 0.9}}, 1)));
  EXPECT_TRUE(render::depths_have_converged(
      probes({{2, 0.5}, {4, 0.9}, {8, 0.9}, {16, 0.9}, {32, 0.9}}, 1)))
      << "paths go on between dark walls";
  EXPECT_FALSE(render::depths_have_converged(probes({{2, 0}, {4, 0}, {8, 0}}, 1)))
      << "behind thick glass nothing is seen before the last of its surfaces";
}

TEST_F(StudyTest, GoesDeeperUntilNoLightIsLost) {
  // A closed room: light is reflected between the walls until the lamp or the walls absorb it.
  render::Scene room = beam_scene({0, 0, 0.5}, {0, 0, -1}, render::LinearRgb{0});
  add_sphere(room, {0, 0, 0}, 3, diffuse({0.8, 0.8, 0.8}));
  add_sphere(room, {0, 2, 0}, 0.3, emissive({1, 1, 1}, 5));
  StudyLedger ledger = short_ledger();
  render::RenderMonitor monitor;
  const StudyObserver observer;
  render::Study study(room, kSettings, {}, kOptions, ledger, observer, monitor);
  study.run({});
  const Measurement result = study.measurement();
  ASSERT_FALSE(result.depths.empty());
  EXPECT_TRUE(result.depths_have_converged);
  EXPECT_GT(result.depths.back().depth, 4 * kSettings.depth);
  EXPECT_LT(result.depths[result.depths.size() - 2].loss.value, 1e-3);
  // Each further wall reflects .8 of the light of the previous one, or a little less.
  const auto own = std::ranges::find(result.depths, kSettings.depth, &render::DepthLoss::depth);
  EXPECT_GT(own->loss.value, 0.15);
  EXPECT_EQ(result.depths.size(), ledger.plan->depths.size());
}

TEST_F(StudyTest, FindsFloatAndDoubleToAgree) {
  StudyLedger ledger = short_ledger();
  run(ledger);
  const auto precision = measurement(ledger).precision;
  ASSERT_TRUE(precision);
  EXPECT_EQ(precision->refusal, std::nullopt);
  EXPECT_LE(precision->mean_difference.interval.from, 0);
  EXPECT_GE(precision->mean_difference.interval.to, 0);
  EXPECT_LT(std::abs(precision->mean_difference.value), 0.01);
}

TEST_F(StudyTest, GoesOnWhereItWasStoppedAndComesToTheSame) {
  StudyLedger whole = short_ledger();
  run(whole);

  StudyLedger parts = short_ledger();
  for (int stops = 0; stops < 4; ++stops) run(parts, 3);
  EXPECT_LT(parts.points.size(), whole.points.size());
  run(parts);
  // The points beyond the plan depend on timing.
  for (const render::StudyTask& task : whole.plan->tasks) {
    if (task.kind != render::StudyTask::Kind::Point) continue;
    const Point result = point_of(measurement(parts), task);
    const Point expected = point_of(measurement(whole), task);
    EXPECT_EQ(result.error.value, expected.error.value) << describe(task);
    EXPECT_EQ(result.difference.rmse, expected.difference.rmse) << describe(task);
    EXPECT_EQ(result.timings.size(), expected.timings.size()) << describe(task);
  }
  EXPECT_EQ(parts.depths.size(), whole.depths.size());
  EXPECT_EQ(parts.precisions.size(), whole.precisions.size());
}

TEST_F(StudyTest, LosesNothingWhenItIsStopped) {
  StudyLedger ledger = short_ledger();
  run(ledger, 4);
  EXPECT_TRUE(ledger.reference);
  EXPECT_EQ(ledger.points.size(), 3u);
  const Measurement result = measurement(ledger);
  EXPECT_EQ(result.points.size(), 3u);
  EXPECT_FALSE(result.left_out.empty());
}

TEST_F(StudyTest, SaysWhatThereWasNoTimeFor) {
  StudyLedger ledger = short_ledger();
  ledger.spent_seconds = kOptions.budget_seconds;
  run(ledger);
  EXPECT_TRUE(ledger.reference) << "without it nothing is a point";
  const Measurement result = measurement(ledger);
  EXPECT_TRUE(result.points.empty());
  ASSERT_FALSE(result.left_out.empty());
  for (const auto& left_out : result.left_out) EXPECT_EQ(left_out.reason, "there was no time left");
}

TEST_F(StudyTest, RecommendsForTheFullSizeWhereASmallerPictureWasMeasured) {
  StudyLedger ledger = short_ledger();
  for (render::ConfigurationCost& cost : ledger.plan->costs) cost.build_seconds = 1000;
  run(ledger);
  for (Point& point : ledger.points) {
    // Not as measured: on a busy machine that is too long.
    for (double& seconds : point.timings) seconds = 1000 + 1e-5 * point.samples;
  }
  ledger.other_seconds = 50;
  const Measurement at_size = measurement(ledger);
  render::RenderSettings larger = kSettings;
  larger.width *= 10;
  const Measurement smaller = measurement_of(ledger, larger, kOptions);
  ASSERT_EQ(smaller.recommendations.size(), at_size.recommendations.size());
  for (std::size_t i = 0; i < smaller.recommendations.size(); ++i) {
    EXPECT_FALSE(smaller.recommendations[i].is_measured);
    // Reading, writing and building stay the same; milliseconds of tracing become ten times as
    // long.
    EXPECT_GE(smaller.recommendations[i].seconds.value, 1050);
    EXPECT_LT(smaller.recommendations[i].seconds.value, 1100);
  }
}

TEST_F(StudyTest, GivesTheReasonWhyASceneIsTracedInDouble) {
  render::Scene narrow = beam_scene({0, 0, 5}, {0, 0, 0}, render::LinearRgb{1});
  add_sphere(narrow, {0, 0, 0}, 1, diffuse({0.5, 0.5, 0.5}));
  add_sphere(narrow, {0, 0, 0}, 1 - 1e-6, diffuse({0.5, 0.5, 0.5}));
  StudyLedger ledger = short_ledger();
  render::RenderMonitor monitor;
  const StudyObserver observer;
  const render::Study study(narrow, kSettings, {}, kOptions, ledger, observer, monitor);
  EXPECT_EQ(ledger.precision_bound,
            "in float two surfaces are 1e-06 of the larger radius apart, where 1.53e-05 is needed");
}

TEST_F(StudyTest, RecommendsTheFewestSamplesForABlackScene) {
  render::Scene black = beam_scene({0, 0, 5}, {0, 0, 0}, render::LinearRgb{0});
  add_sphere(black, {0, 0, 0}, 1, diffuse({0.5, 0.5, 0.5}));
  StudyLedger ledger = short_ledger();
  render::RenderMonitor monitor;
  const StudyObserver observer;
  render::Study study(black, kSettings, {}, kOptions, ledger, observer, monitor);
  study.run({});
  const Measurement result = measurement(ledger);
  for (const Point& point : result.points) EXPECT_EQ(point.error.value, 0);
  ASSERT_EQ(result.recommendations.size(), 1u);
  EXPECT_EQ(result.recommendations[0].samples, 8);
  EXPECT_EQ(result.recommendations[0].goal, std::nullopt);
}

}  // namespace
}  // namespace sdlc::test
