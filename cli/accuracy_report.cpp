#include "cli/accuracy_report.hpp"

#include <algorithm>
#include <cstdint>
#include <string_view>

#include <fmt/format.h>

#include "render/film/film.hpp"
#include "render/scene/settings.hpp"

namespace sdlc::cli {
namespace {

/// Three significant digits: the interval is wider than any further ones.
std::string percent(double share) { return fmt::format("{:.3g}", 100 * share); }

/// The warning about emissive spheres that few paths reached: their light may be missing in both
/// the picture and the estimated error.
std::string scarce_light(const render::RenderSettings& settings,
                         const std::vector<render::ReachedEmitter>& emitters) {
  const bool is_one = emitters.size() == 1;
  const auto fewest = std::ranges::min_element(
      emitters, {}, [](const render::ReachedEmitter& emitter) { return emitter.paths; });
  const char* hint = settings.light_sampling == render::LightSampling::On
                         ? "more samples find it unless it is hidden"
                         : "more samples, or --light-sampling on, find it unless it is hidden";
  return fmt::format(
      "{} emissive sphere{} reached by fewer than {} paths, {}by {}: {} light may be missing in "
      "the picture and in its error estimate; {}",
      emitters.size(), is_one ? " was" : "s were", render::EmitterTally::kEnough,
      is_one ? "" : "one of them ", fewest->paths, is_one ? "its" : "their", hint);
}

std::string_view words_of(render::LightPath kind) {
  switch (kind) {
    case render::LightPath::Visible: return "directly from the camera";
    case render::LightPath::Reflected: return "from the camera through mirrors or glass";
    case render::LightPath::Direct: return "from a diffuse or rough surface";
    default: return "from a diffuse or rough surface through mirrors or glass (a caustic)";
  }
}

/// The warning that the error is unknown although the replicates agree.
std::string rare_light(const render::RenderResult& result) {
  const std::vector<render::RarePath>& rare = result.rare_paths;
  // On ties the reverse order prefers caustics, the likeliest to be missing.
  const auto weight = [](const render::RarePath& path) {
    return path.paths < render::EmitterTally::kWitnesses ? 3 * path.radiance : path.radiance;
  };
  const auto worst = std::ranges::max_element(rare.rbegin(), rare.rend(), {}, weight);
  if (!result.kernel.casters.empty() && worst->kind == render::LightPath::Caustic &&
      worst->paths >= render::EmitterTally::kWitnesses) {
    return fmt::format(
        "the error is unknown: {} bright paths by way of mirrors or glass make much of the noise, "
        "and more may be missing; more samples find them",
        worst->paths);
  }
  const bool is_specular =
      worst->kind == render::LightPath::Caustic || worst->kind == render::LightPath::Reflected;
  const bool may_help =
      is_specular && result.kernel.casters.empty() && result.kernel.may_have_casters;
  return fmt::format(
      "the error is unknown: {} path{} reached a light {}, so some of its light may be missing in "
      "the picture; more samples{} may find it",
      worst->paths == 0 ? "no" : fmt::format("only {}", worst->paths), worst->paths > 1 ? "s" : "",
      words_of(worst->kind), may_help ? ", or --light-sampling caustics," : "");
}

/// Why the picture of a render with --denoise is as it was.
std::string_view why_plain(const render::RenderResult& result) {
  if (result.min_samples < render::kMinReplicatedSamples) {
    return "that takes at least 8 samples per pixel";
  }
  return result.error ? "that would not lower its error" : "its error would be unknown";
}

/// The warning about an error that no kind of path hides: the picture is black and its paths were
/// cut off, or squares of the radiance are beyond the range of numbers.
std::string unknown_error(const render::Picture& picture) {
  double largest = 0;
  for (const render::LinearRgb& pixel : picture.pixels) {
    largest = std::max({largest, pixel.r, pixel.g, pixel.b});
  }
  if (largest == 0) {
    return "the error is unknown: the picture is black and `depth` cut off paths, which may find "
           "light with a larger one";
  }
  return fmt::format("the error is unknown: the radiance is so {}",
                     largest > 1 ? "large that its square overflows; use darker lights"
                                 : "small that its square underflows; use brighter lights");
}

}  // namespace

std::string describe_samples(const render::RenderResult& result) {
  if (result.min_samples == result.max_samples) {
    return fmt::format("{} sample{}", result.max_samples, result.max_samples == 1 ? "" : "s");
  }
  return fmt::format("{} to {} samples", result.min_samples, result.max_samples);
}

std::string describe_error(const render::RenderResult& result) {
  std::string text;
  if (result.error) {
    const std::string before =
        result.plain_error ? percent(result.plain_error->relative_error) + " % → " : "";
    text +=
        fmt::format(", error {}{} % ({} to {} %)", before, percent(result.error->relative_error),
                    percent(result.error->interval.from), percent(result.error->interval.to));
  } else if (result.min_samples >= render::kMinReplicatedSamples) {
    text += ", error unknown";
  }
  const double cut = static_cast<double>(result.truncated_paths) /
                     static_cast<double>(std::max<std::uint64_t>(result.camera_samples, 1));
  constexpr double kMinReported = 1e-3;
  if (cut >= kMinReported) text += fmt::format(", {} % of paths cut by depth", percent(cut));
  return text;
}

std::string describe_light_choice(const render::Kernel& kernel) {
  return kernel.light_choice.empty() ? "" : ", light sampling " + kernel.light_choice;
}

std::vector<std::string> accuracy_warnings(const render::RenderSettings& settings,
                                           const render::RenderResult& result) {
  std::vector<std::string> warnings;
  if (settings.error && !result.has_reached_error) {
    const std::string reached =
        result.error ? fmt::format("it is up to {:.5g} %", 100 * result.error->interval.to)
                     : std::string("it is unknown");
    const char* limit =
        settings.seconds && result.max_samples < static_cast<std::uint64_t>(settings.samples)
            ? "time"
            : "number of samples";
    warnings.push_back(fmt::format("the error did not reach {} % within the allowed {}: {}",
                                   percent(*settings.error), limit, reached));
  }
  // With fewer samples the error is not estimated, so nothing can be missing in it.
  const bool has_estimate = result.min_samples >= render::kMinReplicatedSamples;
  if (!result.rare_paths.empty()) {
    warnings.push_back(rare_light(result));
  } else if (has_estimate && !result.error) {
    warnings.push_back(unknown_error(result.picture));
  }
  const bool has_noise = !result.error || result.error->relative_error > 0;
  if (settings.is_denoised && !result.plain_error && has_noise) {
    warnings.push_back(fmt::format("the picture is not denoised: {}", why_plain(result)));
  }
  if (has_estimate && !result.scarce_emitters.empty()) {
    warnings.push_back(scarce_light(settings, result.scarce_emitters));
  }
  return warnings;
}

std::vector<std::pair<std::string, std::string>> picture_metadata(
    const render::RenderSettings& settings, const render::RenderResult& result,
    const std::optional<render::ToneMapping>& mapping) {
  std::vector<std::pair<std::string, std::string>> entries{
      {"sdlc:samples", result.min_samples == result.max_samples
                           ? fmt::to_string(result.max_samples)
                           : fmt::format("{}-{}", result.min_samples, result.max_samples)}};
  render::for_each_setting([&](const auto& setting) {
    entries.emplace_back(fmt::format("sdlc:{}", setting.name),
                         fmt::format("{}", render::shown(settings.*setting.member)));
  });
  entries.emplace_back("sdlc:truncated_paths", fmt::to_string(result.truncated_paths));
  entries.emplace_back("sdlc:scarce_emitters", fmt::to_string(result.scarce_emitters.size()));
  if (mapping) entries.emplace_back("sdlc:tone", name_of(mapping->tone));
  if (mapping && mapping->exposure != 0) {
    entries.emplace_back("sdlc:exposure", fmt::to_string(mapping->exposure));
  }
  if (result.plain_error) entries.emplace_back("sdlc:denoised", "true");
  if (result.error) {
    entries.emplace_back("sdlc:relative_error", fmt::to_string(result.error->relative_error));
    entries.emplace_back(
        "sdlc:relative_error_interval",
        fmt::format("{} {}", result.error->interval.from, result.error->interval.to));
  }
  return entries;
}

}  // namespace sdlc::cli
