#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/report/report.hpp"
#include "render/scene/choices.hpp"

namespace sdlc::cli {
namespace {

std::array<std::string, 4> parts_of(const render::Way& way) {
  return {way.sampler == render::SamplerKind::Sobol ? "Sobol'" : "independent",
          fmt::format("light sampling {}", name_of(way.light_sampling)),
          std::string(name_of(way.precision)), fmt::format("depth {}", way.depth)};
}

/// What --precision takes: Mixed is how a scene is traced of which float was asked for.
std::string_view precision_word(render::Precision precision) {
  return name_of(precision == render::Precision::Mixed ? render::Precision::Float : precision);
}

}  // namespace

std::string render_flags(const render::Measurement& measurement, const render::Way& way,
                         int samples) {
  const render::Way& own = measurement.own;
  const render::GivenFlags& given = measurement.given;
  std::string flags = fmt::format("--samples {}", samples);
  if (given.sampler || way.sampler != own.sampler) {
    flags += fmt::format(" --sampler {}", name_of(way.sampler));
  }
  if (given.light_sampling || way.light_sampling != own.light_sampling) {
    flags += fmt::format(" --light-sampling {}", name_of(way.light_sampling));
  }
  if (given.precision || precision_word(way.precision) != precision_word(own.precision)) {
    flags += fmt::format(" --precision {}", precision_word(way.precision));
  }
  if (given.depth || way.depth != own.depth) flags += fmt::format(" --depth {}", way.depth);
  if (!given.others.empty()) flags += " " + given.others;
  return flags;
}

std::string describe_way(const render::Way& way) {
  return fmt::format("{}", fmt::join(parts_of(way), ", "));
}

std::string describe_way(const render::Measurement& measurement, const render::Way& way) {
  const std::array parts = parts_of(way);
  std::vector<std::string> told;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const bool is_shared = std::ranges::all_of(
        measurement.series,
        [&](const render::Series& series) { return parts_of(series.way)[i] == parts[i]; });
    if (!is_shared) told.push_back(parts[i]);
  }
  return told.empty() ? describe_way(way) : fmt::format("{}", fmt::join(told, ", "));
}

}  // namespace sdlc::cli
