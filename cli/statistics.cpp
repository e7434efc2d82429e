#include "cli/statistics.hpp"

#include <nlohmann/json.hpp>

#include "cli/environment.hpp"
#include "cli/json_values.hpp"
#include "cli/kernel_options.hpp"
#include "cli/precision_json.hpp"
#include "render/scene/settings.hpp"

namespace sdlc::cli {
namespace {

nlohmann::ordered_json number_or_null(const std::optional<render::ErrorEstimate>& error,
                                      double render::ErrorEstimate::*member) {
  return error ? nlohmann::ordered_json((*error).*member) : nullptr;
}

nlohmann::ordered_json interval_or_null(const std::optional<render::ErrorEstimate>& error,
                                        render::Interval render::ErrorEstimate::*member) {
  if (!error) return nullptr;
  const render::Interval interval = (*error).*member;
  return {interval.from, interval.to};
}

/// A whole number where all pixels have as many.
nlohmann::ordered_json mean_samples(const render::RenderResult& result,
                                    const render::RenderSettings& settings) {
  if (result.min_samples == result.max_samples) return result.max_samples;
  return static_cast<double>(result.camera_samples) /
         static_cast<double>(settings.window().pixels());
}

}  // namespace

std::string to_json(const RenderStatistics& statistics, const render::RenderResult& result) {
  const auto per_second = [&](std::uint64_t count) {
    return result.render_seconds > 0 ? static_cast<double>(count) / result.render_seconds : 0;
  };
  const render::RenderSettings& settings = statistics.settings;
  nlohmann::ordered_json json{
      {"scene", statistics.scene},         {"spheres", statistics.spheres},
      {"instances", statistics.instances}, {"width", settings.width},
      {"height", settings.height},         {"samples", mean_samples(result, settings)},
  };
  render::for_each_setting([&](const auto& setting) {
    json[std::string(setting.name)] = render::shown(settings.*setting.member);
  });
  json.update({
      {"threads", result.threads},
      {"instruction_set", instruction_set(result.kernel)},
      {"precision", name_of(result.kernel.precision)},
      {"precision_bound", deciding_bound_json(result.kernel.bounds)},
      {"kernel", name_of(result.kernel)},
      {"features", statistics.features},
      {"parse_seconds", statistics.compile.parse_seconds},
      {"lower_seconds", statistics.compile.lower_seconds},
      {"build_seconds", result.build_seconds},
      {"render_seconds", result.render_seconds},
      {"denoise_seconds", result.denoise_seconds},
      {"write_seconds", statistics.write_seconds},
      {"camera_samples", result.camera_samples},
      {"rays", result.rays},
      {"samples_per_second", per_second(result.camera_samples)},
      {"rays_per_second", per_second(result.rays)},
      {"peak_rss_bytes", peak_resident_bytes()},
      {"render_rss_bytes", statistics.render_rss_bytes},
      {"bvh_bytes", result.bvh_bytes},
      {"least_samples", result.min_samples},
      {"most_samples", result.max_samples},
      {"relative_error", number_or_null(result.error, &render::ErrorEstimate::relative_error)},
      {"relative_error_interval", interval_or_null(result.error, &render::ErrorEstimate::interval)},
      {"denoised", result.plain_error.has_value()},
      {"plain_relative_error",
       number_or_null(result.plain_error ? result.plain_error : result.error,
                      &render::ErrorEstimate::relative_error)},
      {"mean_radiance", number_or_null(result.error, &render::ErrorEstimate::mean)},
      {"mean_radiance_interval",
       interval_or_null(result.error, &render::ErrorEstimate::mean_interval)},
      {"error_goal", settings.error ? nlohmann::ordered_json(*settings.error) : nullptr},
      {"has_reached_error", result.has_reached_error},
      {"adaptive", settings.is_adaptive},
      {"truncated_paths", result.truncated_paths},
      {"light_choice", result.kernel.light_choice.empty()
                           ? nlohmann::ordered_json()
                           : nlohmann::ordered_json(result.kernel.light_choice)},
      {"sampled_lights", result.sampled_lights},
      {"scarce_emitters", result.scarce_emitters.size()},
      {"nonfinite_samples", result.nonfinite_samples},
  });
  if (statistics.is_merged) {
    for (const char* name :
         {"threads", "instruction_set", "precision_bound", "kernel", "parse_seconds",
          "lower_seconds", "build_seconds", "render_seconds", "denoise_seconds", "write_seconds",
          "samples_per_second", "rays_per_second", "peak_rss_bytes", "render_rss_bytes",
          "bvh_bytes"}) {
      json[name] = nullptr;
    }
  }
  return to_line(json);
}

}  // namespace sdlc::cli
