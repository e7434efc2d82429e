#include "render/measure/plan.hpp"

#include <algorithm>
#include <set>
#include <vector>

#include <gtest/gtest.h>

namespace sdlc::test {
namespace {

using render::StudyPlan;
using render::StudyRequest;
using render::StudyTask;
using Kind = render::StudyTask::Kind;

constexpr render::Configuration kOwn{};

/// A megapixel; ten million samples take a second.
StudyRequest request(double budget_seconds, double seconds_per_sample = 1e-7) {
  StudyRequest request{.settings = {.width = 1000, .height = 1000, .samples = 48},
                       .reference_configuration = kOwn,
                       .budget_seconds = budget_seconds};
  render::Configuration independent = kOwn;
  independent.sampler = render::SamplerKind::Independent;
  render::Configuration twice = kOwn;
  twice.precision = render::Precision::Double;
  for (const render::Configuration& configuration : {kOwn, independent, twice}) {
    request.costs.push_back(
        {.configuration = configuration, .seconds_per_sample = seconds_per_sample});
  }
  return request;
}

double seconds_of(const StudyPlan& plan) {
  double sum = 0;
  for (const StudyTask& task : plan.tasks) sum += plan.seconds_of(task);
  return sum;
}

int max_samples(const StudyPlan& plan) {
  int most = 0;
  for (const StudyTask& task : plan.tasks) {
    if (task.kind == Kind::Point) most = std::max(most, task.samples);
  }
  return most;
}

TEST(StudyPlan, FitsIntoItsBudgetAndUsesIt) {
  for (const double budget : {200.0, 600.0, 3600.0}) {
    const StudyPlan plan = plan_study(request(budget));
    EXPECT_LE(seconds_of(plan), budget);
    EXPECT_GE(seconds_of(plan), 0.3 * budget);
    EXPECT_EQ(plan.width, 1000);
  }
}

TEST(StudyPlan, TimesNumbersOfThreadsFirstIfThatIsRequested) {
  EXPECT_EQ(render::thread_counts_up_to(1), (std::vector{1}));
  EXPECT_EQ(render::thread_counts_up_to(2), (std::vector{1, 2}));
  EXPECT_EQ(render::thread_counts_up_to(7), (std::vector{1, 2, 3, 4, 6, 7}));
  EXPECT_EQ(render::thread_counts_up_to(16), (std::vector{1, 2, 3, 4, 6, 8, 12, 16}));
  StudyRequest sweep = request(600);
  sweep.thread_counts = {1, 2, 4};
  const StudyPlan plan = plan_study(sweep);
  EXPECT_LE(seconds_of(plan), 600);
  double seconds = 0;
  for (int round = 0; round < render::kThreadRounds; ++round) {
    const StudyTask& task = plan.tasks[static_cast<std::size_t>(round)];
    EXPECT_EQ(task.kind, Kind::Threads);
    EXPECT_EQ(task.round, round);
    seconds += plan.seconds_of(task);
  }
  EXPECT_GE(seconds, 0.1 * 600);
  EXPECT_LE(seconds, 0.2 * 600);
  EXPECT_EQ(plan.tasks[render::kThreadRounds].kind, Kind::Reference);
}

TEST(StudyPlan, TakesMoreSamplesWithMoreTime) {
  EXPECT_GT(max_samples(plan_study(request(3600))), max_samples(plan_study(request(200))));
}

TEST(StudyPlan, MakesThePictureSmallerWhereTimeIsShort) {
  const StudyPlan plan = plan_study(request(10));
  EXPECT_LT(plan.width, 500);
  EXPECT_EQ(plan.width, plan.height);
  EXPECT_LE(seconds_of(plan), 10);
  EXPECT_EQ(max_samples(plan), 64);
}

TEST(StudyPlan, UsesItsBudgetWhereThePictureIsSmaller) {
  for (double budget = 2; budget < 40; budget *= 1.15) {
    const StudyPlan plan = plan_study(request(budget));
    ASSERT_LT(plan.width, 1000);
    EXPECT_LE(seconds_of(plan), 0.85 * budget) << budget;
    EXPECT_GE(seconds_of(plan), 0.83 * budget) << budget;
  }
}

TEST(StudyPlan, BeginsWithAReferenceOfFourTimesTheMostSamples) {
  const StudyPlan plan = plan_study(request(600));
  EXPECT_EQ(plan.tasks.front().kind, Kind::Reference);
  EXPECT_EQ(plan.tasks.front().samples, plan.reference_samples);
  EXPECT_GE(plan.reference_samples, 4 * max_samples(plan));
}

TEST(StudyPlan, HasTheScenesOwnSamplesToo) {
  const StudyPlan plan = plan_study(request(600));
  const StudyTask own{.configuration = kOwn, .samples = 48};
  EXPECT_EQ(std::ranges::count(plan.tasks, own), 1);
}

TEST(StudyPlan, AsksForNothingTwice) {
  const StudyPlan plan = plan_study(request(600));
  for (const StudyTask& task : plan.tasks) {
    EXPECT_EQ(std::ranges::count(plan.tasks, task), 1) << describe(task);
  }
}

TEST(StudyPlan, PlansNothingOfWhatIsRefused) {
  StudyRequest refused = request(600);
  refused.costs[2].refusal = "--precision double: no";
  const StudyPlan plan = plan_study(refused);
  for (const StudyTask& task : plan.tasks) {
    EXPECT_NE(task.configuration.precision, render::Precision::Double);
    EXPECT_NE(task.kind, Kind::Precisions);
  }
}

TEST(StudyPlan, LooksAtDepthsOnBothSidesOfTheScenesOwn) {
  StudyRequest odd = request(600);
  odd.settings.depth = 12;
  EXPECT_EQ(plan_study(odd).depths, (std::vector{2, 4, 8, 12, 16}));
  odd.settings.depth = 1;
  EXPECT_EQ(plan_study(odd).depths, (std::vector{1, 2}));
  odd.settings.depth = 1000;
  EXPECT_EQ(plan_study(odd).depths, (std::vector{2, 4, 8, 16, 32, 64, 128, 1000}));
}

// Otherwise all repetitions of a point could fall into a period in which the machine is slow.
TEST(StudyPlan, SpreadsRepeatsOverTheWholeTime) {
  const StudyPlan plan = plan_study(request(600));
  std::vector<int> rounds;
  for (const StudyTask& task : plan.tasks) {
    if (task.kind == Kind::Repeat) rounds.push_back(task.round);
  }
  ASSERT_FALSE(rounds.empty());
  EXPECT_TRUE(std::ranges::is_sorted(rounds));
  EXPECT_EQ(rounds.back(), 2);
}

TEST(StudyPlan, RendersFewerThingsWhereBuildingTakesMostOfTheTime) {
  StudyRequest heavy = request(60);
  for (render::ConfigurationCost& cost : heavy.costs) cost.build_seconds = 1.5;
  const StudyPlan lean = plan_study(heavy);
  EXPECT_LE(seconds_of(lean), 60);
  EXPECT_LT(lean.tasks.size(), 10u);
  EXPECT_GT(lean.width, 250) << "not at the price of a picture of nothing";
  const bool has_others = std::ranges::any_of(
      lean.tasks, [](const StudyTask& task) { return task.configuration != kOwn; });
  EXPECT_TRUE(has_others);

  for (render::ConfigurationCost& cost : heavy.costs) cost.build_seconds = 100;
  for (const StudyTask& task : plan_study(heavy).tasks) EXPECT_EQ(task.configuration, kOwn);
}

TEST(StudyPlan, HoldsForAPictureOfOnePixel) {
  StudyRequest tiny = request(1);
  tiny.settings.width = tiny.settings.height = 1;
  const StudyPlan plan = plan_study(tiny);
  EXPECT_EQ(plan.width, 1);
  EXPECT_LE(seconds_of(plan), 1);
}

}  // namespace
}  // namespace sdlc::test
