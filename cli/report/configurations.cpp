#include <algorithm>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/report/report.hpp"
#include "render/measure/configuration.hpp"
#include "render/scene/settings.hpp"

namespace sdlc::cli {
namespace {

std::vector<std::string> report_parts(const render::Configuration& configuration) {
  std::vector<std::string> parts = render::parts_of(configuration);
  std::ranges::replace(parts, std::string("sobol"), std::string("Sobol'"));
  return parts;
}

/// The way as flags ask for it: --precision takes no Mixed, which Float becomes where it must.
render::Configuration asked_for(render::Configuration configuration) {
  if (configuration.precision == render::Precision::Mixed)
    configuration.precision = render::Precision::Float;
  return configuration;
}

}  // namespace

std::string render_flags(const render::Measurement& measurement,
                         const render::Configuration& configuration, int samples) {
  const render::Configuration asked = asked_for(configuration), own = asked_for(measurement.own);
  const render::GivenFlags& given = measurement.given;
  std::string flags = fmt::format("--samples {}", samples);
  render::for_each_configuration_setting([&](const auto& setting) {
    const auto value = asked.*setting.member;
    if (value == own.*setting.member && !std::ranges::count(given.of_configuration, setting.name))
      return;
    flags += fmt::format(" {} {}", render::flag_of(setting.name), render::shown(value));
  });
  if (!given.others.empty()) flags += " " + given.others;
  return flags;
}

std::string describe_configuration(const render::Configuration& configuration) {
  return fmt::format("{}", fmt::join(report_parts(configuration), ", "));
}

std::string describe_configuration(const render::Measurement& measurement,
                                   const render::Configuration& configuration) {
  const std::vector<std::string> parts = report_parts(configuration);
  std::vector<std::string> told;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const bool is_shared =
        std::ranges::all_of(measurement.series, [&](const render::Series& series) {
          return report_parts(series.configuration)[i] == parts[i];
        });
    if (!is_shared) told.push_back(parts[i]);
  }
  return told.empty() ? describe_configuration(configuration)
                      : fmt::format("{}", fmt::join(told, ", "));
}

}  // namespace sdlc::cli
