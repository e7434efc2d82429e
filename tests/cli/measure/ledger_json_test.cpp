#include "cli/measure/ledger_json.hpp"

#include <cmath>
#include <cstddef>
#include <exception>
#include <stdexcept>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sdlc::cli {
namespace {

using render::StudyLedger;

StudyLedger read_ledger(const Json& json) {
  StudyLedger ledger;
  read_members(json, ledger);
  return ledger;
}

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
      .thread_counts = {1, 3},
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
  ledger.points.push_back({.configuration = configuration,
                           .samples = 16,
                           .timings = {0.3, 0.31},
                           .rays = 500,
                           .error = {0.1, {0.09, 0.11}},
                           .error_spread = 0.004,
                           .difference = {.rmse = 0.07,
                                          .relative_mse = 0.02,
                                          .trimmed_relative_mse = 0.01,
                                          .psnr = 23,
                                          .largest = {-0.5, 2, 1, 2}},
                           .flip = 0.04,
                           .scarce_emitters = 2,
                           .cut_paths = 0.125});
  ledger.depths.push_back({.depth = 2, .round = 1, .mean = 0.6, .seconds = 0.2, .cut_paths = 0.5});
  ledger.depths.push_back({.depth = 7, .round = 1, .mean = 0.7, .seconds = 0.4, .cut_paths = 0.25});
  ledger.precisions.push_back({.round = 1,
                               .mean = 0.7,
                               .other_mean = 0.70001,
                               .rms_difference = 1e-3,
                               .seconds = 0.4,
                               .other_seconds = 0.8});
  ledger.threads.push_back({.threads = 3, .round = 1, .seconds = 0.7, .is_same = true});
  return ledger;
}

TEST(LedgerJson, ComesBackWithEveryBit) {
  const Json json = value_json(full_ledger());
  const std::string text = json.dump();
  EXPECT_EQ(value_json(read_ledger(parse_json(text))).dump(), text);
  for (const char* value :
       {"independent", "mixed", "0.3333333333333333", "1000003", "0.70001", "\"a \\\"bound\\\"\"",
        "blue", "-0.5", "\"repeat\"", "500", "\"thread_counts\":[1,3]", "\"is_same\":true"}) {
    EXPECT_NE(text.find(value), std::string::npos) << value;
  }
}

TEST(LedgerJson, OfNothingComesBackToo) {
  const StudyLedger ledger = read_ledger(value_json(StudyLedger{}));
  EXPECT_FALSE(ledger.plan);
  EXPECT_FALSE(ledger.reference);
}

TEST(LedgerJson, RefusesFieldsThatDoNotFit) {
  const std::string text = value_json(full_ledger()).dump(1);
  const auto complaint = [&](const std::string& from, const std::string& to) -> std::string {
    std::string changed = text;
    const std::size_t at = changed.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    changed.replace(at, from.size(), to);
    try {
      read_ledger(parse_json(changed));
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "nothing";
  };
  const auto samples = "its `samples` is not a whole number from 1 to 134217728";
  for (const char* number : {"0", "-1", "1e300", "16.5", "134217729", "99999999999999999999"}) {
    EXPECT_THAT(complaint("\"samples\": 512,\n  \"seed\"",
                          fmt::format("\"samples\": {},\n  \"seed\"", number)),
                testing::HasSubstr(samples));
  }
  EXPECT_THAT(complaint("\"width\": 4", "\"width\": -16"), testing::HasSubstr("its `width`"));
  EXPECT_THAT(complaint("\"depth\": 7", "\"depth\": 0"), testing::HasSubstr("its `depth`"));
  EXPECT_THAT(complaint("\"seed\": 1000003", "\"seed\": -1"),
              testing::HasSubstr("its `seed` is not a whole number from 0 on"));
  EXPECT_THAT(complaint("\"flip\": 0.04", "\"flip\": \"much\""),
              testing::HasSubstr("its `flip` is no number"));
  EXPECT_THAT(complaint("\"flip\"", "\"flop\""), testing::HasSubstr("its `flip` is missing"));
  EXPECT_THAT(complaint("\"independent\"", "\"dependent\""),
              testing::HasSubstr("its `sampler` is `dependent`, which is unknown"));
  EXPECT_THAT(complaint("\"repeat\"", "\"retreat\""),
              testing::HasSubstr("its `kind` is `retreat`, which is unknown"));
  EXPECT_THAT(complaint("\"blue\"", "\"mauve\""),
              testing::HasSubstr("its `channel` is `mauve`, which is unknown"));
  for (const char* whole : {"[]", "{}"})
    EXPECT_THROW(read_ledger(Json::parse(whole)), std::exception);
  EXPECT_THROW(parse_json(text.substr(0, text.size() / 2)), std::invalid_argument);
  EXPECT_THAT(complaint("\"flip\": 0.04", "\"flip\": 1e999"),
              testing::HasSubstr("it has a number that is too large"));
}

}  // namespace
}  // namespace sdlc::cli
