#include "cli/measure/measurement_json.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "cli/measure/json_types.hpp"

namespace sdlc::cli {
namespace {

using render::Measurement;

constexpr const char* kFormat = "sdlc-measurement";
constexpr int kFormatVersion = 1;

Json point_json(const render::Point& point) {
  Json json = configuration_json(point.configuration);
  json["samples"] = point.samples;
  json["timings"] = point.timings;
  put(json, "seconds", point.seconds);
  json["samples_per_second"] = point.samples_per_second;
  json["rays_per_second"] = point.rays_per_second;
  // Relative to the reference's own noise, unlike the error of the difference.
  Json difference = difference_json(point.difference);
  difference.erase("relative_error");
  put(json, "relative_error", point.error);
  json["relative_error_spread"] = point.error_spread;
  json.update(difference);
  json["flip"] = point.flip;
  json["cut_paths"] = point.cut_share;
  json["scarce_emitters"] = point.scarce_emitters;
  json["standing"] = name_of(point.dominance);
  return json;
}

render::Point point_of(const Json& json) {
  render::Point point{
      .configuration = configuration_of(json),
      .samples = whole_field(json, "samples", 1, kMaxMeasuredSamples),
      .timings = list_field(json, "timings",
                            [](const Json& seconds) { return number_of(seconds, "timings"); }),
      .seconds = measured_of(json, "seconds"),
      .error = measured_of(json, "relative_error"),
      .error_spread = field<double>(json, "relative_error_spread")};
  const bool is_timed =
      point.seconds.value > 0 && std::ranges::all_of(point.timings, [](double s) { return s > 0; });
  if (!is_timed) throw std::invalid_argument("it took no time");
  if (!(point.error.value >= 0)) throw std::invalid_argument("its `relative_error` is invalid");
  return point;
}

Json reference_json(const render::Reference& reference) {
  Json json = configuration_json(reference.configuration);
  json["samples"] = reference.samples;
  json["seed"] = reference.seed;
  json["seconds"] = reference.seconds;
  put(json, "relative_error", reference.error);
  json["mean_radiance"] = reference.mean_radiance;
  json["scarce_emitters"] = reference.scarce_emitters;
  return json;
}

Json series_json(const render::Series& series) {
  Json json = configuration_json(series.configuration);
  json["points"] = series.points;
  json["slope"] = nullptr;
  json["slope_interval"] = nullptr;
  if (series.slope) put(json, "slope", *series.slope);
  return json;
}

Json depth_json(const render::DepthLoss& depth) {
  Json json{{"depth", depth.depth}};
  put(json, "loss", depth.loss);
  json["relative_seconds"] = depth.seconds;
  json["cut_paths"] = depth.cut_share;
  return json;
}

Json precision_json(const render::PrecisionDifference& precision) {
  Json json{{"taken", name_of(precision.taken)},
            {"other", name_of(precision.other)},
            {"bound", precision.bound},
            {"refusal", precision.refusal.empty() ? Json() : Json(precision.refusal)}};
  put(json, "mean_difference", precision.mean_difference);
  json["rms_difference"] = precision.rms_difference;
  json["relative_seconds"] = precision.seconds;
  return json;
}

Json recommendation_json(const Measurement& measurement,
                         const render::Recommendation& recommendation) {
  Json json{
      {"goal", recommendation.goal > 0 ? Json(recommendation.goal) : Json()},
      {"flags", render_flags(measurement, recommendation.configuration, recommendation.samples)},
      {"samples", recommendation.samples}};
  json.update(configuration_json(recommendation.configuration));
  json["is_measured"] = recommendation.is_measured;
  put(json, "relative_error", recommendation.error);
  put(json, "seconds", recommendation.seconds);
  return json;
}

Json recommendations_json(const Measurement& measurement) {
  Json all = Json::array();
  for (std::size_t i = 0; i < measurement.recommendations.size(); ++i) {
    Json json = recommendation_json(measurement, measurement.recommendations[i]);
    json["is_main"] = i == measurement.main_recommendation;
    all.push_back(json);
  }
  return all;
}

Json left_out_json(const render::LeftOut& left_out) {
  Json json = configuration_json(left_out.configuration);
  json["samples"] = left_out.samples > 0 ? Json(left_out.samples) : Json();
  json["reason"] = left_out.reason;
  return json;
}

Json against_json(const render::Comparison& against) {
  Json points = Json::array();
  for (const render::PointChange& point : against.points) {
    Json json = configuration_json(point.configuration);
    json["samples"] = point.samples;
    put(json, "relative_error_before", point.error_before);
    put(json, "relative_error", point.error_after);
    put(json, "seconds_before", point.seconds_before);
    put(json, "seconds", point.seconds_after);
    json["error"] = name_of(point.error);
    points.push_back(json);
  }
  Json json{{"version", against.earlier}, {"points", points}};
  json["time_ratio"] = nullptr;
  json["time_ratio_interval"] = nullptr;
  if (against.time_ratio) put(json, "time_ratio", *against.time_ratio);
  json["time"] = name_of(against.time);
  json["notes"] = against.notes;
  return json;
}

}  // namespace

std::string to_json(const Report& report, const std::string& scene_digest) {
  const Measurement& measurement = report.measurement;
  Json machine = Json::object();
  for (const auto& [name, value] : report.provenance.machine) machine[name] = value;
  Json json{
      {"format", kFormat},
      {"format_version", kFormatVersion},
      {"version", report.provenance.version},
      {"command", report.provenance.command},
      {"machine", machine},
      {"scene", report.provenance.scene},
      {"scene_digest", scene_digest},
      {"width", measurement.width},
      {"height", measurement.height},
      {"full_width", measurement.full_width},
      {"full_height", measurement.full_height},
      {"samples", measurement.own_samples},
      {"seed", measurement.seed},
      {"threads", measurement.threads},
      {"budget_seconds", measurement.budget_seconds},
      {"spent_seconds", measurement.spent_seconds},
      {"other_seconds", measurement.other_seconds},
      {"nonfinite_samples", measurement.nonfinite_samples},
      {"is_complete", measurement.is_complete},
      {"own", configuration_json(measurement.own)},
      {"reference", measurement.reference ? reference_json(*measurement.reference) : Json()},
      {"points", array_json(measurement.points, point_json)},
      {"series", array_json(measurement.series, series_json)},
      {"depths", array_json(measurement.depths, depth_json)},
      {"depths_have_converged", measurement.depths_have_converged},
      {"precision", measurement.precision ? precision_json(*measurement.precision) : Json()},
      {"as_it_is",
       measurement.as_it_is ? recommendation_json(measurement, *measurement.as_it_is) : Json()},
      {"recommendations", recommendations_json(measurement)},
      {"left_out", array_json(measurement.left_out, left_out_json)},
      {"against", report.against ? against_json(*report.against) : Json()},
      {"notes", report.notes}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

EarlierMeasurement read_measurement(std::string_view text) {
  const Json json = parse_json(text);
  if (!json.is_object() || !json.contains("format") || json.at("format") != kFormat) {
    throw std::invalid_argument("it is not a JSON report of `sdlc measure`");
  }
  if (const int version = whole_field(json, "format_version", 1); version != kFormatVersion) {
    throw std::invalid_argument(fmt::format(
        "it has version {} of the format, and this sdlc reads {}", version, kFormatVersion));
  }
  EarlierMeasurement earlier{.version = field<std::string>(json, "version"),
                             .scene_digest = field<std::string>(json, "scene_digest"),
                             .width = whole_field(json, "width", 1),
                             .height = whole_field(json, "height", 1),
                             .full_width = whole_field(json, "full_width", 1),
                             .full_height = whole_field(json, "full_height", 1),
                             .seed = field<std::uint64_t>(json, "seed"),
                             .threads = whole_field(json, "threads", 1),
                             .is_complete = field<bool>(json, "is_complete")};
  const Json& machine = any_field(json, "machine");
  if (!machine.is_object()) throw std::invalid_argument("its `machine` is not an object");
  for (const auto& [name, value] : machine.items()) {
    earlier.machine.emplace_back(name, string_of(value, name));
  }
  earlier.points = list_field(json, "points", point_of);
  return earlier;
}

}  // namespace sdlc::cli
