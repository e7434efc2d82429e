#include "cli/measure/ledger_json.hpp"

#include <cmath>
#include <cstddef>
#include <exception>
#include <stdexcept>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sdlc::test {
namespace {

using render::StudyLedger;

/// Every field with a different number.
StudyLedger full_ledger() {
  const render::Configuration configuration{.sampler = render::SamplerKind::Independent,
                                            .light_sampling = render::LightSampling::Off,
                                            .precision = render::Precision::Mixed,
                                            .depth = 7};
  render::Configuration other = configuration;
  other.precision = render::Precision::Double;
  StudyLedger ledger{.precision_bound = "a \"bound\"",
                     .other_seconds = 0.1,
                     .spent_seconds = 1.0 / 3,
                     .nonfinite_samples = 3};
  ledger.plan = render::StudyPlan{
      .width = 4,
      .height = 3,
      .costs = {{.configuration = configuration, .build_seconds = 0.25, .seconds_per_sample = 1e-7},
                {.configuration = other, .refusal = "no"}},
      .reference_configuration = configuration,
      .reference_samples = 512,
      .depths = {2, 7},
      .probe_samples = 8,
      .tasks = {{.kind = render::StudyTask::Kind::Reference,
                 .configuration = configuration,
                 .samples = 512},
                {.kind = render::StudyTask::Kind::Repeat,
                 .configuration = configuration,
                 .samples = 16,
                 .round = 2}}};
  ledger.reference = render::Reference{.configuration = configuration,
                                       .samples = 512,
                                       .seed = 1'000'003,
                                       .seconds = 2.5,
                                       .error = {0.01, {0.009, 0.011}},
                                       .mean_radiance = 0.7,
                                       .scarce_emitters = 1};
  ledger.renders.push_back({.configuration = configuration,
                            .samples = 16,
                            .seconds = 0.3,
                            .camera_samples = 192,
                            .rays = 500});
  ledger.evaluations.push_back({.configuration = configuration,
                                .samples = 16,
                                .error = {0.1, {0.09, 0.11}},
                                .error_spread = 0.004,
                                .difference = {.rmse = 0.07,
                                               .relative_error = 0.1,
                                               .relative_mse = 0.02,
                                               .trimmed_relative_mse = 0.01,
                                               .psnr = 23,
                                               .largest = {-0.5, 2, 1, 2}},
                                .flip = 0.04,
                                .scarce_emitters = 2,
                                .cut_share = 0.125});
  ledger.depths.push_back({.depth = 2, .round = 1, .mean = 0.6, .seconds = 0.2, .cut_share = 0.5});
  ledger.depths.push_back({.depth = 7, .round = 1, .mean = 0.7, .seconds = 0.4, .cut_share = 0.25});
  ledger.precisions.push_back({.round = 1,
                               .mean = 0.7,
                               .other_mean = 0.70001,
                               .rms_difference = 1e-3,
                               .seconds = 0.4,
                               .other_seconds = 0.8});
  return ledger;
}

TEST(LedgerJson, ComesBackWithEveryBit) {
  const std::string text = cli::to_json(full_ledger());
  EXPECT_EQ(cli::to_json(cli::read_ledger(text)), text);
  for (const char* value : {"independent", "mixed", "0.3333333333333333", "1000003", "0.70001",
                            "\"a \\\"bound\\\"\"", "blue", "-0.5", "\"repeat\""}) {
    EXPECT_NE(text.find(value), std::string::npos) << value;
  }
}

TEST(LedgerJson, OfNothingComesBackToo) {
  const std::string text = cli::to_json(StudyLedger{});
  const StudyLedger ledger = cli::read_ledger(text);
  EXPECT_FALSE(ledger.plan);
  EXPECT_FALSE(ledger.reference);
}

TEST(LedgerJson, RefusesWhatIsNone) {
  const std::string text = cli::to_json(full_ledger());
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string changed = text;
    changed.replace(changed.find(from), from.size(), to);
    return changed;
  };
  EXPECT_THROW(cli::read_ledger(text.substr(0, text.size() / 2)), std::exception);
  EXPECT_THROW(cli::read_ledger("[]"), std::exception);
  EXPECT_THROW(cli::read_ledger("{}"), std::exception);
  EXPECT_THROW(cli::read_ledger(with("independent", "dependent")), std::exception);
  EXPECT_THROW(cli::read_ledger(with("\"repeat\"", "\"retreat\"")), std::exception);
  EXPECT_THROW(cli::read_ledger(with("\"flip\"", "\"flop\"")), std::exception);
  EXPECT_THROW(cli::read_ledger(with("\"blue\"", "\"mauve\"")), std::exception);
}

TEST(LedgerJson, RefusesWhatDoesNotGoTogether) {
  using Kind = render::StudyTask::Kind;
  const auto complaint = [](auto change) -> std::string {
    StudyLedger ledger = full_ledger();
    change(ledger);
    try {
      cli::read_ledger(cli::to_json(ledger));
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "nothing";
  };
  using Ledger = StudyLedger&;
  EXPECT_EQ(complaint([](Ledger) {}), "nothing");
  EXPECT_EQ(complaint([](Ledger l) { l.plan.reset(); }), "it has results but no `plan`");
  EXPECT_EQ(complaint([](Ledger l) { l.reference.reset(); }),
            "it has `evaluations` but no `reference`");
  EXPECT_EQ(complaint([](Ledger l) { l.renders.clear(); }),
            "one of its `evaluations` was never timed");
  EXPECT_EQ(complaint([](Ledger l) { l.evaluations.push_back(l.evaluations[0]); }),
            "one of its `evaluations` is duplicated");
  EXPECT_EQ(complaint([](Ledger l) { l.evaluations[0].error.value = -1; }),
            "one of its `evaluations` has no error");
  EXPECT_EQ(complaint([](Ledger l) { l.plan->width = l.plan->height = 1 << 20; }),
            "its picture has more than 268435456 pixels");
  EXPECT_EQ(complaint([](Ledger l) { l.plan->costs.clear(); }), "its `costs` are empty");
  EXPECT_EQ(complaint([](Ledger l) { l.plan->costs[0].refusal = "no"; }),
            "it refuses the scene's own configuration");
  EXPECT_EQ(complaint([](Ledger l) { l.plan->costs[0].build_seconds = -1; }),
            "one of its `costs` is negative");
  EXPECT_EQ(complaint([](Ledger l) {
              l.plan->depths = {2, 8};
            }),
            "its `depths` lack that of the scene");
  EXPECT_EQ(complaint([](Ledger l) { l.plan->depths = {7, 2}; }), "its `depths` do not ascend");
  EXPECT_EQ(complaint([](Ledger l) { l.plan->depths = {7, 7}; }), "its `depths` do not ascend");
  EXPECT_EQ(complaint([](Ledger l) { l.plan->tasks.clear(); }),
            "its first task is not the reference");
  EXPECT_EQ(complaint([](Ledger l) { l.plan->tasks.erase(l.plan->tasks.begin()); }),
            "its first task is not the reference");
  EXPECT_EQ(complaint([](Ledger l) { l.depths.pop_back(); }),
            "its `depths` of round 1 differ from the plan");
  EXPECT_EQ(complaint([](Ledger l) {
              l.plan->costs.pop_back();
              l.plan->tasks.push_back({.kind = Kind::Precisions, .samples = 8});
            }),
            "its `costs` lack the other precision");
  EXPECT_EQ(complaint([](Ledger l) { l.spent_seconds = -1; }), "one of its times is negative");
}

TEST(LedgerJson, RefusesNumbersThatDoNotFit) {
  const std::string text = cli::to_json(full_ledger());
  const auto complaint = [&](const std::string& from, const std::string& to) -> std::string {
    std::string changed = text;
    const std::size_t at = changed.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    changed.replace(at, from.size(), to);
    try {
      cli::read_ledger(changed);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "nothing";
  };
  const auto samples = "its `samples` is not a whole number from 1 to 134217728";
  for (const char* number : {"0", "-1", "1e300", "16.5", "134217729", "99999999999999999999"}) {
    EXPECT_THAT(complaint("\"samples\": 512", std::string("\"samples\": ") + number),
                testing::HasSubstr(samples));
  }
  EXPECT_THAT(complaint("\"width\": 4", "\"width\": -16"), testing::HasSubstr("its `width`"));
  EXPECT_THAT(complaint("\"depth\": 7", "\"depth\": 0"), testing::HasSubstr("its `depth`"));
  EXPECT_THAT(complaint("\"seconds\": 2.5", "\"seconds\": 0"),
              testing::HasSubstr("its `seconds` is not above 0"));
  EXPECT_THAT(complaint("\"seed\": 1000003", "\"seed\": -1"),
              testing::HasSubstr("its `seed` is not a whole number from 0 on"));
  EXPECT_THAT(complaint("\"flip\": 0.04", "\"flip\": null"),
              testing::HasSubstr("its `flip` is no number"));
  EXPECT_THAT(complaint("\"flip\": 0.04", "\"flip\": 1e999"),
              testing::HasSubstr("it has a number that is too large"));
}

}  // namespace
}  // namespace sdlc::test
