#include "cli/override_options.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>

#include <fmt/format.h>

#include "cli/amounts.hpp"
#include "cli/usage_error.hpp"
#include "cli/whole_number.hpp"
#include "cli/words.hpp"
#include "lang/object/object.hpp"
#include "lang/schema/schema.hpp"

namespace sdlc::cli {
namespace {

const lang::Property& render_property(std::size_t index) {
  return lang::kind_info(lang::ObjectKind::Render).properties[index];
}

/// `--light-sampling` of `light_sampling`.
std::string flag_of(const lang::Property& property) {
  std::string flag = fmt::format("--{}", property.name);
  std::ranges::replace(flag, '_', '-');
  return flag;
}

/// A flag for a property that is a word or a name.
void add_override(CLI::App& command, std::size_t index, std::optional<std::string>& value) {
  const lang::Property& property = render_property(index);
  CLI::Option* option = command.add_option(flag_of(property), value, std::string(property.doc));
  if (!property.words.empty()) option->check(one_of(property.words));
}

/// A flag for a property that is a whole number.
template <typename T>
void add_override(CLI::App& command, std::size_t index, std::optional<T>& value) {
  const lang::Property& property = render_property(index);
  WholeNumbers range{.lowest = property.range == lang::Range::AtLeastOne ? 1u : 0u};
  if (std::is_same_v<T, int>) range.highest = static_cast<std::uint64_t>(lang::kMaxWholeNumber);
  add_whole_number(
      command, flag_of(property), range,
      [&value](std::uint64_t number) { value = static_cast<T>(number); },
      std::string(property.doc));
}

void add_instances(CLI::App& command, lang::Instancing& instancing) {
  using lang::Instancing;
  static constexpr std::array<std::string_view, 3> kWords{"auto", "always", "never"};
  static constexpr std::array kMeanings{Instancing::Auto, Instancing::Always, Instancing::Never};
  command
      .add_option_function<std::string>(
          "--instances",
          [&instancing](const std::string& word) {
            const auto found = std::ranges::find(kWords, word);
            instancing = kMeanings[static_cast<std::size_t>(found - kWords.begin())];
          },
          "Hold what a def places again and again once: slower to trace, as it saves memory; auto: "
          "in scenes of more than a million spheres")
      ->check(one_of(kWords));
}

/// A flag whose value is an amount that `parse` reads.
void add_amount(CLI::App& command, const std::string& flag, std::optional<double>& value,
                double (*parse)(const std::string& flag, const std::string& text),
                const std::string& type, const std::string& doc) {
  command
      .add_option_function<std::string>(
          flag, [flag, parse, &value](const std::string& text) { value = parse(flag, text); }, doc)
      ->type_name(type);
}

void add_goals(CLI::App& command, lang::Overrides& overrides) {
  const lang::Property& error = render_property(lang::render_property::kError);
  add_amount(command, flag_of(error), overrides.error, parse_share, "E", std::string(error.doc));
  add_amount(command, "--time", overrides.seconds, parse_duration, "T",
             "Go on until so much time has passed, such as `10s`, `500ms`, `2min` or `1h`. --error "
             "and --time take the place of the scene's samples and error; with both, whichever is "
             "reached first ends it; --samples: the most of them");
  command.add_flag("--adaptive", overrides.is_adaptive,
                   "More samples where there is more noise, up to the error to reach");
}

}  // namespace

void add_override_options(CLI::App& command, lang::Overrides& overrides) {
  using namespace lang::render_property;
  add_override(command, kWidth, overrides.width);
  add_override(command, kHeight, overrides.height);
  add_override(command, kSamples, overrides.samples);
  add_override(command, kDepth, overrides.depth);
  add_override(command, kSeed, overrides.seed);
  add_override(command, kThreads, overrides.threads);
  add_override(command, kTone, overrides.tone);
  add_override(command, kCamera, overrides.camera);
  add_override(command, kPrecision, overrides.precision);
  add_override(command, kSampler, overrides.sampler);
  add_override(command, kLightSampling, overrides.light_sampling);
  add_goals(command, overrides);
  add_instances(command, overrides.instancing);
}

void check_goals(const lang::Overrides& overrides, const lang::LoweredScene& lowered) {
  const bool is_plain = !lowered.camera;
  if (!overrides.is_adaptive || lowered.settings.error || is_plain) return;
  throw UsageError(overrides.seconds
                       ? "--adaptive: --time alone is no error to reach; add one, such as "
                         "--error 1%"
                       : "--adaptive: there is no error to reach; add one, such as --error 1%, or "
                         "`error: 1%` in the scene's `render`");
}

}  // namespace sdlc::cli
