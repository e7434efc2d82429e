#include <algorithm>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "cli/report/report.hpp"
#include "render/measure/configuration.hpp"
#include "render/scene/settings.hpp"

namespace sdlc::cli {
namespace {

/// The configuration as requested by flags: --precision cannot request Mixed, which is chosen for
/// Float if necessary.
render::Configuration requested(render::Configuration configuration) {
  if (configuration.precision == render::Precision::Mixed)
    configuration.precision = render::Precision::Float;
  return configuration;
}

}  // namespace

std::string render_flags(const render::Measurement& measurement,
                         const render::Configuration& configuration, int samples) {
  const render::Configuration wanted = requested(configuration), own = requested(measurement.own);
  const render::GivenFlags& given = measurement.given;
  std::string flags = fmt::format("--samples {}", samples);
  render::for_each_configuration_setting([&](const auto& setting) {
    const auto value = wanted.*setting.member;
    if constexpr (std::is_same_v<decltype(value), const bool>) {
      if (value) flags += fmt::format(" {}", render::flag_of(setting.name));
      return;
    }
    if (value == own.*setting.member && !std::ranges::count(given.of_configuration, setting.name))
      return;
    flags += fmt::format(" {} {}", render::flag_of(setting.name), render::shown(value));
  });
  if (!given.others.empty()) flags += " " + given.others;
  return flags;
}

void add_flags(render::Measurement& measurement) {
  const auto add = [&](render::Recommendation& choice) {
    choice.flags = render_flags(measurement, choice.configuration, choice.samples);
  };
  std::ranges::for_each(measurement.recommendations, add);
  if (measurement.as_it_is) add(*measurement.as_it_is);
}

std::string describe_configuration(const render::Measurement& measurement,
                                   const render::Configuration& configuration) {
  const std::vector<std::string> parts = render::parts_of(configuration);
  std::vector<std::string> distinct;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const bool is_shared =
        std::ranges::all_of(measurement.series, [&](const render::Series& series) {
          return render::parts_of(series.configuration)[i] == parts[i];
        });
    if (!is_shared) distinct.push_back(parts[i]);
  }
  const std::string text = render::join_parts(distinct);
  return text.empty() ? render::describe(configuration) : text;
}

}  // namespace sdlc::cli
