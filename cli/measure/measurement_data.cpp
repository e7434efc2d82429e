#include "cli/measure/measurement_data.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <tuple>

#include <fmt/format.h>

#include "cli/measure/json.hpp"

namespace sdlc::cli {

using render::Measurement;

SDLC_MEMBERS(render::Series, configuration, points, slope)
SDLC_MEMBERS(render::DepthLoss, depth, loss, relative_seconds, cut_paths)
SDLC_MEMBERS(render::PrecisionDifference, taken, other, bound, refusal, mean_difference,
             rms_difference, relative_seconds)
SDLC_MEMBERS(render::ThreadScaling, threads, seconds, speed_up)
SDLC_MEMBERS(render::Recommendation, goal, samples, configuration, is_measured, relative_error,
             seconds, flags, is_main)
SDLC_MEMBERS(render::LeftOut, configuration, samples, reason)
SDLC_MEMBERS(render::PointChange, configuration, samples, relative_error_before, relative_error,
             seconds_before, seconds, error)
SDLC_MEMBERS(render::Comparison, version, points, time_ratio, time, notes)

namespace {

constexpr const char* kFormat = "sdlc-measurement";
constexpr int kFormatVersion = 1;

}  // namespace

template <>
inline constexpr std::tuple kMembers<Measurement>{
    Member("width", &Measurement::width, Range{1}),
    Member("height", &Measurement::height, Range{1}),
    Member("full_width", &Measurement::full_width, Range{1}),
    Member("full_height", &Measurement::full_height, Range{1}),
    WriteOnly("samples", &Measurement::samples),
    Member("seed", &Measurement::seed),
    Member("threads", &Measurement::threads, Range{1}),
    WriteOnly("budget_seconds", &Measurement::budget_seconds),
    WriteOnly("spent_seconds", &Measurement::spent_seconds),
    WriteOnly("other_seconds", &Measurement::other_seconds),
    WriteOnly("light_choice", &Measurement::light_choice),
    WriteOnly("nonfinite_samples", &Measurement::nonfinite_samples),
    Member("is_complete", &Measurement::is_complete),
    WriteOnly("own", &Measurement::own),
    WriteOnly("reference", &Measurement::reference),
    Member("points", &Measurement::points),
    WriteOnly("series", &Measurement::series),
    WriteOnly("depths", &Measurement::depths),
    WriteOnly("depths_have_converged", &Measurement::depths_have_converged),
    WriteOnly("precision", &Measurement::precision),
    WriteOnly("thread_scaling", &Measurement::thread_scaling),
    WriteOnly("thread_scaling_samples", &Measurement::thread_scaling_samples),
    WriteOnly("thread_pictures_are_same", &Measurement::thread_pictures_are_same),
    WriteOnly("as_it_is", &Measurement::as_it_is),
    WriteOnly("recommendations", &Measurement::recommendations),
    WriteOnly("left_out", &Measurement::left_out)};

SDLC_MEMBERS(Provenance, version, command, machine, scene, scene_digest)

namespace {

std::string csv_text(const Json& json) {
  if (json.is_null()) return "";
  if (json.is_string()) return json.get<std::string>();
  return json.is_number_float() ? fmt::to_string(json.get<double>()) : json.dump();
}

/// Calls `add(name, text)` for each cell. No text contains a comma, a quote or a line end.
template <typename Add>
void for_each_cell(const render::Point& point, Add&& add) {
  const Json json = value_json(point);
  for (const auto& [name, value] : json.items()) {
    if (const std::string base = name.substr(0, name.rfind("_interval")); base != name) {
      add(base + "_from", csv_text(value[0]));
      add(base + "_to", csv_text(value[1]));
    } else if (value.is_object()) {
      for (const auto& [part, number] : value.items()) {
        if (!number.is_string()) add(part == "value" ? name : name + "_" + part, csv_text(number));
      }
    } else {
      add(name, value.is_array() ? fmt::to_string(value.size()) : csv_text(value));
    }
  }
}

}  // namespace

std::string to_json(const Report& report) {
  Json json{{"format", kFormat}, {"format_version", kFormatVersion}};
  write_members(json, report.provenance);
  write_members(json, report.measurement);
  json["against"] = value_json(report.against);
  json["notes"] = report.notes;
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string to_csv(const Measurement& measurement) {
  std::string names, rows;
  const auto append = [](std::string& line, const std::string& text) {
    if (!line.empty() && line.back() != '\n') line += ',';
    line += text;
  };
  for_each_cell({}, [&](const std::string& name, const std::string&) { append(names, name); });
  for (const render::Point& point : measurement.points) {
    for_each_cell(point, [&](const std::string&, const std::string& text) { append(rows, text); });
    rows += "\r\n";
  }
  return names + "\r\n" + rows;
}

EarlierMeasurement read_measurement(std::string_view text) {
  const Json json = parse_json(text);
  if (!json.is_object() || !json.contains("format") || json.at("format") != kFormat) {
    throw std::invalid_argument("it is not a JSON report of `sdlc measure`");
  }
  int version = 0;
  read_value(field(json, "format_version"), "format_version", {}, version);
  if (version != kFormatVersion) {
    throw std::invalid_argument(fmt::format(
        "it has version {} of the format, and this sdlc reads {}", version, kFormatVersion));
  }
  EarlierMeasurement earlier;
  read_members(json, earlier.provenance);
  read_members(json, earlier.measurement);
  for (std::size_t i = 0; i < earlier.measurement.points.size(); ++i) {
    const render::Point& point = earlier.measurement.points[i];
    const auto refuse = [&](const char* what) {
      throw std::invalid_argument(fmt::format("`points`, number {}: {}", i + 1, what));
    };
    const bool is_timed = point.seconds.value > 0 &&
                          std::ranges::all_of(point.timings, [](double s) { return s > 0; });
    if (!is_timed) refuse("it took no time");
    if (!(point.error.value >= 0)) refuse("its `relative_error` is invalid");
  }
  return earlier;
}

}  // namespace sdlc::cli
