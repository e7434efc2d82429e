#include "cli/accuracy_report.hpp"

#include <algorithm>
#include <cstdint>

#include <fmt/format.h>

#include "render/scene/choices.hpp"

namespace sdlc::cli {
namespace {

/// Two digits more than the interval is wide do not matter: three significant ones in all.
std::string percent(double share) { return fmt::format("{:.3g}", 100 * share); }

/// Light that was met so seldom that the picture may lack some, and its error not show it.
std::string scarce_light(const std::vector<render::ReachedEmitter>& emitters) {
  const auto fewest = std::ranges::min_element(
      emitters, {}, [](const render::ReachedEmitter& emitter) { return emitter.paths; });
  return fmt::format(
      "{} emissive sphere{} reached by fewer than {} paths, of which sphere {} by {}: {} light may "
      "be missing in the picture and in its error; more samples, or --light-sampling on, find it",
      emitters.size(), emitters.size() == 1 ? " was" : "s were", render::EmitterTally::kEnough,
      fewest->sphere, fewest->paths, emitters.size() == 1 ? "its" : "their");
}

}  // namespace

std::string describe_samples(const render::RenderResult& result) {
  if (result.least_samples == result.most_samples) {
    return fmt::format("{} sample{}", result.most_samples, result.most_samples == 1 ? "" : "s");
  }
  return fmt::format("{} to {} samples", result.least_samples, result.most_samples);
}

std::string describe_error(const render::RenderResult& result) {
  std::string text;
  if (result.error) {
    text += fmt::format(", error {} % ({} to {} %)", percent(result.error->relative_error),
                        percent(result.error->interval.from), percent(result.error->interval.to));
  }
  const double cut = static_cast<double>(result.truncated_paths) /
                     static_cast<double>(std::max<std::uint64_t>(result.camera_samples, 1));
  constexpr double kWorthTelling = 1e-3;
  if (cut >= kWorthTelling) text += fmt::format(", {} % of paths cut by depth", percent(cut));
  return text;
}

std::vector<std::string> accuracy_warnings(const render::RenderSettings& settings,
                                           const render::RenderResult& result) {
  std::vector<std::string> warnings;
  if (settings.error && !result.has_reached_error) {
    const std::string reached =
        result.error ? fmt::format("it is at most {} %", percent(result.error->interval.to))
                     : std::string("fewer than 8 samples a pixel do not tell what it is");
    const char* limit = result.most_samples >= static_cast<std::uint64_t>(settings.samples)
                            ? "the samples that are allowed"
                            : "the time that is allowed";
    warnings.push_back(fmt::format("the error did not come down to {} % with {}: {}",
                                   percent(*settings.error), limit, reached));
  }
  if (!result.scarce_emitters.empty()) warnings.push_back(scarce_light(result.scarce_emitters));
  return warnings;
}

std::vector<std::pair<std::string, std::string>> picture_metadata(
    const render::RenderSettings& settings, const render::RenderResult& result) {
  std::vector<std::pair<std::string, std::string>> entries{
      {"sdlc:samples", result.least_samples == result.most_samples
                           ? fmt::to_string(result.most_samples)
                           : fmt::format("{}-{}", result.least_samples, result.most_samples)},
      {"sdlc:depth", fmt::to_string(settings.depth)},
      {"sdlc:seed", fmt::to_string(settings.seed)},
      {"sdlc:sampler", std::string(name_of(settings.sampler))},
      {"sdlc:light_sampling", std::string(name_of(settings.light_sampling))}};
  if (result.error) {
    entries.emplace_back("sdlc:relative_error", fmt::to_string(result.error->relative_error));
    entries.emplace_back(
        "sdlc:relative_error_interval",
        fmt::format("{} {}", result.error->interval.from, result.error->interval.to));
  }
  return entries;
}

}  // namespace sdlc::cli
