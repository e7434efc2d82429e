#include "cli/measure/ledger_json.hpp"

#include <exception>
#include <string>

#include <gtest/gtest.h>

namespace sdlc::test {
namespace {

using render::StudyLedger;

/// Every field with a number of its own.
StudyLedger full_ledger() {
  const render::Way way{.sampler = render::SamplerKind::Independent,
                        .light_sampling = render::LightSampling::Off,
                        .precision = render::Precision::Mixed,
                        .depth = 7};
  StudyLedger ledger{.precision_bound = "a \"bound\"",
                     .other_seconds = 0.1,
                     .spent_seconds = 1.0 / 3,
                     .nonfinite_samples = 3};
  ledger.plan = render::StudyPlan{
      .width = 4,
      .height = 3,
      .costs = {{.way = way, .build_seconds = 0.25, .seconds_a_sample = 1e-7, .refusal = "no"}},
      .reference_way = way,
      .reference_samples = 512,
      .depths = {2, 7},
      .probe_samples = 8,
      .tasks = {{.kind = render::StudyTask::Kind::Repeat, .way = way, .samples = 16, .round = 2}}};
  ledger.reference = render::Reference{.way = way,
                                       .samples = 512,
                                       .seed = 1'000'003,
                                       .seconds = 2.5,
                                       .error = {0.01, {0.009, 0.011}},
                                       .mean_radiance = 0.7,
                                       .scarce_emitters = 1};
  ledger.renders.push_back(
      {.way = way, .samples = 16, .seconds = 0.3, .camera_samples = 192, .rays = 500});
  ledger.evaluations.push_back({.way = way,
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

}  // namespace
}  // namespace sdlc::test
