#include "cli/measure/ledger_json.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "cli/measure/json_types.hpp"
#include "render/image/picture.hpp"

namespace sdlc::cli {
namespace {

using render::StudyTask;

constexpr std::array<std::string_view, 5> kKinds{"reference", "point", "repeat", "depths",
                                                 "precisions"};

Json task_json(const StudyTask& task) {
  return {{"kind", kKinds[static_cast<std::size_t>(task.kind)]},
          {"way", configuration_json(task.configuration)},
          {"samples", task.samples},
          {"round", task.round}};
}

int samples_of(const Json& json, const std::string& name) {
  return whole_field(json, name, 1, kMaxMeasuredSamples);
}

StudyTask task_of(const Json& json) {
  const auto kind = std::ranges::find(kKinds, field<std::string>(json, "kind"));
  if (kind == kKinds.end()) throw std::invalid_argument("its kind is unknown");
  const auto what = static_cast<StudyTask::Kind>(kind - kKinds.begin());
  return {.kind = what,
          .configuration = configuration_of(any_field(json, "way")),
          .samples = samples_of(json, "samples"),
          .round = whole_field(json, "round", 0)};
}

Json cost_json(const render::ConfigurationCost& cost) {
  return {{"way", configuration_json(cost.configuration)},
          {"build_seconds", cost.build_seconds},
          {"seconds_a_sample", cost.seconds_per_sample},
          {"refusal", cost.refusal}};
}

render::ConfigurationCost cost_of(const Json& json) {
  return {.configuration = configuration_of(any_field(json, "way")),
          .build_seconds = field<double>(json, "build_seconds"),
          .seconds_per_sample = field<double>(json, "seconds_a_sample"),
          .refusal = field<std::string>(json, "refusal")};
}

Json plan_json(const render::StudyPlan& plan) {
  return {{"width", plan.width},
          {"height", plan.height},
          {"costs", array_json(plan.costs, cost_json)},
          {"reference_way", configuration_json(plan.reference_configuration)},
          {"reference_samples", plan.reference_samples},
          {"depths", plan.depths},
          {"probe_samples", plan.probe_samples},
          {"tasks", array_json(plan.tasks, task_json)}};
}

render::StudyPlan plan_of(const Json& json) {
  const auto depth = [](const Json& number) {
    return static_cast<int>(whole_of(number, "depths", 1, std::numeric_limits<int>::max()));
  };
  return {.width = whole_field(json, "width", 1),
          .height = whole_field(json, "height", 1),
          .costs = list_field(json, "costs", cost_of),
          .reference_configuration = configuration_of(any_field(json, "reference_way")),
          .reference_samples = samples_of(json, "reference_samples"),
          .depths = list_field(json, "depths", depth),
          .probe_samples = samples_of(json, "probe_samples"),
          .tasks = list_field(json, "tasks", task_of)};
}

Json reference_json(const render::Reference& reference) {
  Json json{{"way", configuration_json(reference.configuration)},
            {"samples", reference.samples},
            {"seed", reference.seed},
            {"seconds", reference.seconds}};
  put(json, "error", reference.error);
  json["mean_radiance"] = reference.mean_radiance;
  json["scarce_emitters"] = reference.scarce_emitters;
  return json;
}

render::Reference reference_of(const Json& json) {
  return {.configuration = configuration_of(any_field(json, "way")),
          .samples = samples_of(json, "samples"),
          .seed = field<std::uint64_t>(json, "seed"),
          .seconds = positive_field(json, "seconds"),
          .error = measured_of(json, "error"),
          .mean_radiance = field<double>(json, "mean_radiance"),
          .scarce_emitters = field<std::uint64_t>(json, "scarce_emitters")};
}

Json render_json(const render::TimedRender& render) {
  return {{"way", configuration_json(render.configuration)},
          {"samples", render.samples},
          {"seconds", render.seconds},
          {"camera_samples", render.camera_samples},
          {"rays", render.rays}};
}

render::TimedRender render_of(const Json& json) {
  return {.configuration = configuration_of(any_field(json, "way")),
          .samples = samples_of(json, "samples"),
          .seconds = positive_field(json, "seconds"),
          .camera_samples = field<std::uint64_t>(json, "camera_samples"),
          .rays = field<std::uint64_t>(json, "rays")};
}

Json evaluation_json(const render::Evaluation& evaluation) {
  Json json{{"way", configuration_json(evaluation.configuration)}, {"samples", evaluation.samples}};
  put(json, "error", evaluation.error);
  json["error_spread"] = evaluation.error_spread;
  json["difference"] = difference_json(evaluation.difference);
  json["flip"] = evaluation.flip;
  json["scarce_emitters"] = evaluation.scarce_emitters;
  json["cut_share"] = evaluation.cut_share;
  return json;
}

render::Evaluation evaluation_of(const Json& json) {
  return {.configuration = configuration_of(any_field(json, "way")),
          .samples = samples_of(json, "samples"),
          .error = measured_of(json, "error"),
          .error_spread = field<double>(json, "error_spread"),
          .difference = difference_of(any_field(json, "difference")),
          .flip = field<double>(json, "flip"),
          .scarce_emitters = field<std::uint64_t>(json, "scarce_emitters"),
          .cut_share = field<double>(json, "cut_share")};
}

Json depth_json(const render::DepthProbe& probe) {
  return {{"depth", probe.depth},
          {"round", probe.round},
          {"mean", probe.mean},
          {"seconds", probe.seconds},
          {"cut_share", probe.cut_share}};
}

render::DepthProbe depth_of(const Json& json) {
  return {.depth = whole_field(json, "depth", 1),
          .round = whole_field(json, "round", 0),
          .mean = field<double>(json, "mean"),
          .seconds = positive_field(json, "seconds"),
          .cut_share = field<double>(json, "cut_share")};
}

Json precision_json(const render::PrecisionProbe& probe) {
  return {{"round", probe.round},           {"mean", probe.mean},
          {"other_mean", probe.other_mean}, {"rms_difference", probe.rms_difference},
          {"seconds", probe.seconds},       {"other_seconds", probe.other_seconds}};
}

render::PrecisionProbe precision_of(const Json& json) {
  return {.round = whole_field(json, "round", 0),
          .mean = field<double>(json, "mean"),
          .other_mean = field<double>(json, "other_mean"),
          .rms_difference = field<double>(json, "rms_difference"),
          .seconds = positive_field(json, "seconds"),
          .other_seconds = positive_field(json, "other_seconds")};
}

[[noreturn]] void refuse(const std::string& what) { throw std::invalid_argument(what); }

/// Checks that the study can follow the plan.
void check(const render::StudyPlan& plan) {
  using Kind = StudyTask::Kind;
  if (std::int64_t{plan.width} * plan.height > render::kMaxPicturePixels) {
    refuse(fmt::format("its picture has more than {} pixels", render::kMaxPicturePixels));
  }
  if (plan.costs.empty()) refuse("its `costs` are empty");
  const render::Configuration& own = plan.costs.front().configuration;
  if (!plan.costs.front().refusal.empty()) refuse("it refuses the scene's own configuration");
  for (const render::ConfigurationCost& cost : plan.costs) {
    if (cost.build_seconds < 0 || cost.seconds_per_sample < 0)
      refuse("one of its `costs` is negative");
  }
  if (!std::ranges::is_sorted(plan.depths, std::less_equal())) refuse("its `depths` do not ascend");
  if (!std::ranges::count(plan.depths, own.depth)) refuse("its `depths` lack that of the scene");
  const bool has_reference_first =
      !plan.tasks.empty() && plan.tasks.front().kind == Kind::Reference &&
      std::ranges::count(plan.tasks, Kind::Reference, &StudyTask::kind) == 1;
  if (!has_reference_first) refuse("its first task is not the reference");
  const bool compares_precisions =
      std::ranges::count(plan.tasks, Kind::Precisions, &StudyTask::kind);
  const bool has_other = std::ranges::any_of(
      plan.costs, [&](const auto& cost) { return cost.configuration.precision != own.precision; });
  if (compares_precisions && !has_other) refuse("its `costs` lack the other precision");
}

/// Depths of one seed are compared with each other, so they must be complete.
void check_depths(const render::StudyPlan& plan, const std::vector<render::DepthProbe>& probes) {
  std::map<int, std::vector<int>> rounds;
  for (const render::DepthProbe& probe : probes) rounds[probe.round].push_back(probe.depth);
  for (auto& [round, depths] : rounds) {
    std::ranges::sort(depths);
    if (depths != plan.depths) {
      refuse(fmt::format("its `depths` of round {} differ from the plan", round));
    }
  }
}

/// A damaged or edited ledger must be detected, and must not cause out-of-range access.
void check(const render::StudyLedger& ledger) {
  if (!ledger.plan) {
    const bool is_empty = !ledger.reference && ledger.renders.empty() &&
                          ledger.evaluations.empty() && ledger.depths.empty() &&
                          ledger.precisions.empty();
    if (!is_empty) refuse("it has results but no `plan`");
    return;
  }
  check(*ledger.plan);
  check_depths(*ledger.plan, ledger.depths);
  if (!ledger.evaluations.empty() && !ledger.reference) {
    refuse("it has `evaluations` but no `reference`");
  }
  for (const render::Evaluation& evaluation : ledger.evaluations) {
    const auto is_of_same = [&](const auto& done) {
      return done.configuration == evaluation.configuration && done.samples == evaluation.samples;
    };
    if (std::ranges::count_if(ledger.evaluations, is_of_same) > 1) {
      refuse("one of its `evaluations` is duplicated");
    }
    if (std::ranges::none_of(ledger.renders, is_of_same)) {
      refuse("one of its `evaluations` was never timed");
    }
    if (!(evaluation.error.value >= 0)) refuse("one of its `evaluations` has no error");
  }
}

}  // namespace

std::string to_json(const render::StudyLedger& ledger) {
  const Json json{{"plan", ledger.plan ? plan_json(*ledger.plan) : Json()},
                  {"reference", ledger.reference ? reference_json(*ledger.reference) : Json()},
                  {"renders", array_json(ledger.renders, render_json)},
                  {"evaluations", array_json(ledger.evaluations, evaluation_json)},
                  {"depths", array_json(ledger.depths, depth_json)},
                  {"precisions", array_json(ledger.precisions, precision_json)},
                  {"precision_bound", ledger.precision_bound},
                  {"other_seconds", ledger.other_seconds},
                  {"spent_seconds", ledger.spent_seconds},
                  {"nonfinite_samples", ledger.nonfinite_samples}};
  return json.dump(1);
}

render::StudyLedger read_ledger(std::string_view text) {
  const Json json = parse_json(text);
  render::StudyLedger ledger{.renders = list_field(json, "renders", render_of),
                             .evaluations = list_field(json, "evaluations", evaluation_of),
                             .depths = list_field(json, "depths", depth_of),
                             .precisions = list_field(json, "precisions", precision_of),
                             .precision_bound = field<std::string>(json, "precision_bound"),
                             .other_seconds = field<double>(json, "other_seconds"),
                             .spent_seconds = field<double>(json, "spent_seconds"),
                             .nonfinite_samples = field<std::uint64_t>(json, "nonfinite_samples")};
  if (ledger.other_seconds < 0 || ledger.spent_seconds < 0) refuse("one of its times is negative");
  const Json &plan = any_field(json, "plan"), &reference = any_field(json, "reference");
  if (!plan.is_null()) ledger.plan = plan_of(plan);
  if (!reference.is_null()) ledger.reference = reference_of(reference);
  check(ledger);
  return ledger;
}

}  // namespace sdlc::cli
