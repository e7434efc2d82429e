#include "lang/lower/settings.hpp"

#include <algorithm>
#include <string_view>
#include <thread>

#include <fmt/format.h>

#include "lang/schema/schema.hpp"

namespace sdlc::lang {
namespace {

using namespace render_property;

std::size_t property_named(std::string_view name) {
  const auto properties = kind_info(ObjectKind::Render).properties;
  const auto found = std::ranges::find(properties, name, &Property::name);
  return static_cast<std::size_t>(found - properties.begin());
}

int lower_threads(const WantedSettings& wanted, int otherwise) {
  const int threads = wanted.get_as<int>(kThreads).value_or(otherwise);
  // A config's number_cores may exceed the number of cores, which means all.
  const bool is_wish =
      wanted.file.format() == SourceFormat::Json && !wanted.overrides.has(kThreads);
  const auto available = static_cast<int>(std::thread::hardware_concurrency());
  return is_wish && threads > available ? 0 : threads;
}

void warn_of_few_samples(const WantedSettings& wanted, const LoweredScene& lowered) {
  // Fewer samples of a pixel give no estimate of its error.
  constexpr int kMinSamples = 8;
  const std::optional<double> error = lowered.settings.error;
  const int samples = lowered.settings.samples;
  if (!error || samples >= kMinSamples) return;
  const bool is_by_flag = wanted.overrides.has(kSamples);
  auto report =
      wanted.sink.report(diag::samples_below_error, wanted.place(is_by_flag ? kError : kSamples),
                         fmt::format("{} sample{}", samples, samples == 1 ? "" : "s"),
                         fmt::format("{:.6g}%", 100 * *error),
                         fmt::format("fewer than {} give no estimate of the error", kMinSamples));
  if (!is_by_flag) report.label(wanted.place(kError), "the requested error");
  report.help(fmt::format("remove `{}`, or set it to at least {}",
                          is_by_flag ? "--samples" : "samples", kMinSamples));
}

/// The requested error and time, and the max samples to reach them.
void lower_goals(const WantedSettings& wanted, LoweredScene& lowered) {
  const Overrides& flags = wanted.overrides;
  render::RenderSettings& settings = lowered.settings;
  const bool is_by_flag = flags.has(kError) || flags.seconds;
  settings.error = is_by_flag ? flags.get<double>(kError) : wanted.render.get<double>(kError);
  settings.seconds = flags.seconds;
  settings.is_denoised = flags.is_denoised;
  settings.is_adaptive = flags.is_adaptive && settings.error;
  // The scene's samples limit only its own goal, and only if they are written.
  const bool takes_samples =
      flags.has(kSamples) || (!is_by_flag && (wanted.is_written(kSamples) || !settings.error));
  settings.samples =
      takes_samples ? wanted.get_as<int>(kSamples).value_or(settings.samples) : render::kMaxSamples;
  warn_of_few_samples(wanted, lowered);
}

}  // namespace

void lower_settings(const WantedSettings& wanted, bool is_plain, LoweredScene& lowered) {
  render::RenderSettings& settings = lowered.settings;
  render::for_each_setting([&]<typename T>(const render::Setting<T>& setting) {
    T& value = settings.*setting.member;
    value = wanted.get_as<T>(property_named(setting.name)).value_or(value);
  });
  if (wanted.overrides.seed) settings.seed = *wanted.overrides.seed;
  settings.threads = lower_threads(wanted, settings.threads);
  lowered.output.output = wanted.render.get<std::string>(kOutput).value_or("");
  if (const auto tone = wanted.get<Word>(kTone)) {
    lowered.output.mapping.tone = render::tone_of(tone->text).value_or(render::Tone::Srgb);
  }
  lowered.output.mapping.exposure = wanted.get<double>(kExposure).value_or(0);
  lowered.precision = wanted.get_as<render::Precision>(kPrecision);
  if (is_plain) {  // a plain picture has no noise
    settings.samples = settings.depth = 1;
  } else {
    lower_goals(wanted, lowered);
  }
}

}  // namespace sdlc::lang
