#include <algorithm>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/report/report.hpp"
#include "render/measure/way.hpp"
#include "render/scene/settings.hpp"

namespace sdlc::cli {
namespace {

std::vector<std::string> report_parts(const render::Way& way) {
  std::vector<std::string> parts = render::parts_of(way);
  std::ranges::replace(parts, std::string("sobol"), std::string("Sobol'"));
  return parts;
}

/// The way as flags ask for it: --precision takes no Mixed, which Float becomes where it must.
render::Way asked_for(render::Way way) {
  if (way.precision == render::Precision::Mixed) way.precision = render::Precision::Float;
  return way;
}

}  // namespace

std::string render_flags(const render::Measurement& measurement, const render::Way& way,
                         int samples) {
  const render::Way asked = asked_for(way), own = asked_for(measurement.own);
  const render::GivenFlags& given = measurement.given;
  std::string flags = fmt::format("--samples {}", samples);
  render::for_each_way_setting([&](const auto& setting) {
    const auto value = asked.*setting.member;
    if (value == own.*setting.member && !std::ranges::count(given.of_way, setting.name)) return;
    flags += fmt::format(" {} {}", render::flag_of(setting.name), render::shown(value));
  });
  if (!given.others.empty()) flags += " " + given.others;
  return flags;
}

std::string describe_way(const render::Way& way) {
  return fmt::format("{}", fmt::join(report_parts(way), ", "));
}

std::string describe_way(const render::Measurement& measurement, const render::Way& way) {
  const std::vector<std::string> parts = report_parts(way);
  std::vector<std::string> told;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const bool is_shared = std::ranges::all_of(
        measurement.series,
        [&](const render::Series& series) { return report_parts(series.way)[i] == parts[i]; });
    if (!is_shared) told.push_back(parts[i]);
  }
  return told.empty() ? describe_way(way) : fmt::format("{}", fmt::join(told, ", "));
}

}  // namespace sdlc::cli
