#include "cli/measure/measurement_csv.hpp"

#include <array>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "render/measure/configuration.hpp"
#include "render/scene/settings.hpp"

namespace sdlc::cli {
namespace {

/// All digits; empty if not finite.
std::string number(double value) { return std::isfinite(value) ? fmt::to_string(value) : ""; }

struct Column {
  const char* name;
  std::string (*text)(const render::Point& point);
};

// No cell contains a comma, a quote or a line end, so none has to be quoted.
constexpr std::array kColumns{
    Column{"seconds", [](const render::Point& p) { return number(p.seconds.value); }},
    Column{"seconds_from", [](const render::Point& p) { return number(p.seconds.interval.from); }},
    Column{"seconds_to", [](const render::Point& p) { return number(p.seconds.interval.to); }},
    Column{"timings", [](const render::Point& p) { return fmt::to_string(p.timings.size()); }},
    Column{"samples_per_second",
           [](const render::Point& p) { return number(p.samples_per_second); }},
    Column{"rays_per_second", [](const render::Point& p) { return number(p.rays_per_second); }},
    Column{"relative_error", [](const render::Point& p) { return number(p.error.value); }},
    Column{"relative_error_from",
           [](const render::Point& p) { return number(p.error.interval.from); }},
    Column{"relative_error_to", [](const render::Point& p) { return number(p.error.interval.to); }},
    Column{"relative_error_spread", [](const render::Point& p) { return number(p.error_spread); }},
    Column{"rmse", [](const render::Point& p) { return number(p.difference.rmse); }},
    Column{"relative_mse",
           [](const render::Point& p) { return number(p.difference.relative_mse); }},
    Column{"relative_mse_trimmed",
           [](const render::Point& p) { return number(p.difference.trimmed_relative_mse); }},
    Column{"psnr", [](const render::Point& p) { return number(p.difference.psnr); }},
    Column{"flip", [](const render::Point& p) { return number(p.flip); }},
    Column{"max_difference",
           [](const render::Point& p) { return number(p.difference.largest.value); }},
    Column{"max_difference_x",
           [](const render::Point& p) { return fmt::to_string(p.difference.largest.x); }},
    Column{"max_difference_y",
           [](const render::Point& p) { return fmt::to_string(p.difference.largest.y); }},
    Column{"cut_paths", [](const render::Point& p) { return number(p.cut_share); }},
    Column{"scarce_emitters",
           [](const render::Point& p) { return fmt::to_string(p.scarce_emitters); }},
    Column{"standing", [](const render::Point& p) { return std::string(name_of(p.dominance)); }},
};

}  // namespace

std::string to_csv(const render::Measurement& measurement) {
  constexpr const char* kEnd = "\r\n";
  std::string text = "samples";
  const auto add = [&](const auto& cell) { text += fmt::format(",{}", cell); };
  render::for_each_configuration_setting([&](const auto& setting) { add(setting.name); });
  for (const Column& column : kColumns) add(column.name);
  text += kEnd;
  for (const render::Point& point : measurement.points) {
    text += fmt::to_string(point.samples);
    render::for_each_configuration_setting(
        [&](const auto& setting) { add(render::shown(point.configuration.*setting.member)); });
    for (const Column& column : kColumns) add(column.text(point));
    text += kEnd;
  }
  return text;
}

}  // namespace sdlc::cli
