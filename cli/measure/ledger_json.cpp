#include "cli/measure/ledger_json.hpp"

#include <array>
#include <stdexcept>
#include <vector>

#include "cli/measure/json_types.hpp"

namespace sdlc::cli {
namespace {

using render::StudyTask;

constexpr std::array<std::string_view, 5> kKinds{"reference", "point", "repeat", "depths",
                                                 "precisions"};

Json task_json(const StudyTask& task) {
  return {{"kind", kKinds[static_cast<std::size_t>(task.kind)]},
          {"way", way_json(task.way)},
          {"samples", task.samples},
          {"round", task.round}};
}

StudyTask task_of(const Json& json) {
  const auto kind = std::ranges::find(kKinds, json.at("kind").get<std::string>());
  if (kind == kKinds.end()) throw std::invalid_argument("a task is of no known kind");
  return {.kind = static_cast<StudyTask::Kind>(kind - kKinds.begin()),
          .way = way_of(json.at("way")),
          .samples = json.at("samples"),
          .round = json.at("round")};
}

Json cost_json(const render::WayCost& cost) {
  return {{"way", way_json(cost.way)},
          {"build_seconds", cost.build_seconds},
          {"seconds_a_sample", cost.seconds_a_sample},
          {"refusal", cost.refusal}};
}

render::WayCost cost_of(const Json& json) {
  return {.way = way_of(json.at("way")),
          .build_seconds = json.at("build_seconds"),
          .seconds_a_sample = json.at("seconds_a_sample"),
          .refusal = json.at("refusal")};
}

template <typename Convert>
auto array_of(const Json& json, Convert convert) {
  std::vector<decltype(convert(json))> items;
  for (const Json& item : json) items.push_back(convert(item));
  return items;
}

Json plan_json(const render::StudyPlan& plan) {
  return {{"width", plan.width},
          {"height", plan.height},
          {"costs", array_json(plan.costs, cost_json)},
          {"reference_way", way_json(plan.reference_way)},
          {"reference_samples", plan.reference_samples},
          {"depths", plan.depths},
          {"probe_samples", plan.probe_samples},
          {"tasks", array_json(plan.tasks, task_json)}};
}

render::StudyPlan plan_of(const Json& json) {
  render::StudyPlan plan{.width = json.at("width"),
                         .height = json.at("height"),
                         .costs = array_of(json.at("costs"), cost_of),
                         .reference_way = way_of(json.at("reference_way")),
                         .reference_samples = json.at("reference_samples"),
                         .depths = json.at("depths").get<std::vector<int>>(),
                         .probe_samples = json.at("probe_samples"),
                         .tasks = array_of(json.at("tasks"), task_of)};
  if (plan.costs.empty() || plan.depths.empty()) throw std::invalid_argument("the plan is empty");
  return plan;
}

Json reference_json(const render::Reference& reference) {
  Json json{{"way", way_json(reference.way)},
            {"samples", reference.samples},
            {"seed", reference.seed},
            {"seconds", reference.seconds}};
  put(json, "error", reference.error);
  json["mean_radiance"] = reference.mean_radiance;
  json["scarce_emitters"] = reference.scarce_emitters;
  return json;
}

render::Reference reference_of(const Json& json) {
  return {.way = way_of(json.at("way")),
          .samples = json.at("samples"),
          .seed = json.at("seed"),
          .seconds = json.at("seconds"),
          .error = measured_of(json, "error"),
          .mean_radiance = json.at("mean_radiance"),
          .scarce_emitters = json.at("scarce_emitters")};
}

Json render_json(const render::TimedRender& render) {
  return {{"way", way_json(render.way)},
          {"samples", render.samples},
          {"seconds", render.seconds},
          {"camera_samples", render.camera_samples},
          {"rays", render.rays}};
}

render::TimedRender render_of(const Json& json) {
  return {.way = way_of(json.at("way")),
          .samples = json.at("samples"),
          .seconds = json.at("seconds"),
          .camera_samples = json.at("camera_samples"),
          .rays = json.at("rays")};
}

Json evaluation_json(const render::Evaluation& evaluation) {
  Json json{{"way", way_json(evaluation.way)}, {"samples", evaluation.samples}};
  put(json, "error", evaluation.error);
  json["error_spread"] = evaluation.error_spread;
  json["difference"] = difference_json(evaluation.difference);
  json["flip"] = evaluation.flip;
  json["scarce_emitters"] = evaluation.scarce_emitters;
  json["cut_share"] = evaluation.cut_share;
  return json;
}

render::Evaluation evaluation_of(const Json& json) {
  return {.way = way_of(json.at("way")),
          .samples = json.at("samples"),
          .error = measured_of(json, "error"),
          .error_spread = json.at("error_spread"),
          .difference = difference_of(json.at("difference")),
          .flip = json.at("flip"),
          .scarce_emitters = json.at("scarce_emitters"),
          .cut_share = json.at("cut_share")};
}

Json depth_json(const render::DepthProbe& probe) {
  return {{"depth", probe.depth},
          {"round", probe.round},
          {"mean", probe.mean},
          {"seconds", probe.seconds},
          {"cut_share", probe.cut_share}};
}

render::DepthProbe depth_of(const Json& json) {
  return {.depth = json.at("depth"),
          .round = json.at("round"),
          .mean = json.at("mean"),
          .seconds = json.at("seconds"),
          .cut_share = json.at("cut_share")};
}

Json precision_json(const render::PrecisionProbe& probe) {
  return {{"round", probe.round},           {"mean", probe.mean},
          {"other_mean", probe.other_mean}, {"rms_difference", probe.rms_difference},
          {"seconds", probe.seconds},       {"other_seconds", probe.other_seconds}};
}

render::PrecisionProbe precision_of(const Json& json) {
  return {.round = json.at("round"),
          .mean = json.at("mean"),
          .other_mean = json.at("other_mean"),
          .rms_difference = json.at("rms_difference"),
          .seconds = json.at("seconds"),
          .other_seconds = json.at("other_seconds")};
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
  const Json json = Json::parse(text);
  render::StudyLedger ledger{.renders = array_of(json.at("renders"), render_of),
                             .evaluations = array_of(json.at("evaluations"), evaluation_of),
                             .depths = array_of(json.at("depths"), depth_of),
                             .precisions = array_of(json.at("precisions"), precision_of),
                             .precision_bound = json.at("precision_bound"),
                             .other_seconds = json.at("other_seconds"),
                             .spent_seconds = json.at("spent_seconds"),
                             .nonfinite_samples = json.at("nonfinite_samples")};
  if (!json.at("plan").is_null()) ledger.plan = plan_of(json.at("plan"));
  if (!json.at("reference").is_null()) ledger.reference = reference_of(json.at("reference"));
  return ledger;
}

}  // namespace sdlc::cli
