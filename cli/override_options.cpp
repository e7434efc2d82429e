#include "cli/override_options.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "cli/amounts.hpp"
#include "cli/usage_error.hpp"
#include "cli/whole_number.hpp"
#include "lang/object/check.hpp"
#include "lang/schema/schema.hpp"
#include "render/scene/settings.hpp"

namespace sdlc::cli {
namespace {

const lang::Property& render_property(std::size_t index) {
  return lang::kind_info(lang::ObjectKind::Render).properties[index];
}

/// A flag for a property that is a word or a name.
void add_word(Command& command, std::size_t index, lang::Overrides& overrides) {
  const lang::Property& property = render_property(index);
  Option option = command.add_text(
      render::flag_of(property.name),
      [index, &overrides](const std::string& word) { overrides.render.emplace_back(index, word); },
      std::string(property.doc));
  if (!property.words.empty()) option.one_of(property.words);
}

/// A flag for a property that is a whole number.
void add_number(Command& command, std::size_t index, lang::Overrides& overrides) {
  const lang::Property& property = render_property(index);
  const bool is_seed = index == lang::render_property::kSeed;
  WholeNumbers range{.lowest = property.range == lang::Range::AtLeastOne ? 1u : 0u};
  if (!is_seed) range.highest = static_cast<std::uint64_t>(lang::kMaxWholeNumber);
  add_whole_number(
      command, render::flag_of(property.name), range,
      [=, &overrides](std::uint64_t number) {
        if (is_seed) {
          overrides.seed = number;
        } else {
          overrides.render.emplace_back(index, static_cast<double>(number));
        }
      },
      std::string(property.doc));
}

void add_instances(Command& command, lang::Instancing& instancing) {
  using lang::Instancing;
  static constexpr std::array<std::string_view, 3> kWords{"auto", "always", "never"};
  static constexpr std::array kMeanings{Instancing::Auto, Instancing::Always, Instancing::Never};
  command
      .add_text(
          "--instances",
          [&instancing](const std::string& word) {
            const auto found = std::ranges::find(kWords, word);
            instancing = kMeanings[static_cast<std::size_t>(found - kWords.begin())];
          },
          "Share equal groups in memory: saves memory, but tracing is slower; auto: in scenes of "
          "more than a million spheres")
      .one_of(kWords);
}

/// A flag whose value is an amount that `parse` reads; `take` is called with it.
void add_amount(Command& command, const std::string& flag,
                double (*parse)(const std::string& flag, const std::string& text),
                const std::function<void(double)>& take, const std::string& type,
                const std::string& doc) {
  command
      .add_text(
          flag, [=](const std::string& text) { take(parse(flag, text)); }, doc)
      .type_name(type);
}

void add_exposure(Command& command, lang::Overrides& overrides) {
  using lang::render_property::kExposure;
  const lang::Property& exposure = render_property(kExposure);
  add_amount(
      command, render::flag_of(exposure.name), parse_signed_number,
      [&](double stops) { overrides.render.emplace_back(kExposure, stops); }, "STOPS",
      std::string(exposure.doc));
}

void add_goals(Command& command, lang::Overrides& overrides) {
  const lang::Property& error = render_property(lang::render_property::kError);
  add_amount(
      command, render::flag_of(error.name), parse_share,
      [&](double share) { overrides.render.emplace_back(lang::render_property::kError, share); },
      "E", std::string(error.doc));
  add_amount(
      command, "--time", parse_duration, [&](double seconds) { overrides.seconds = seconds; }, "T",
      "Time limit, such as `10s`, `500ms`, `2min` or `1h`. --error and --time replace the scene's "
      "samples and error; with both, the render ends when the first is reached; --samples is the "
      "max number");
  command.add_flag("--adaptive", overrides.is_adaptive,
                   "More samples where there is more noise; needs a requested error");
  command.add_flag("--denoise", overrides.is_denoised,
                   "Filter the picture where that lowers its error, which is measured; --error and "
                   "--time are then for the filtered picture");
}

}  // namespace

void add_override_options(Command& command, lang::Overrides& overrides) {
  using namespace lang::render_property;
  for (std::size_t i = 0; i < kCount; ++i) {
    if (render_property(i).type == lang::Type::WholeNumber) add_number(command, i, overrides);
  }
  for (std::size_t i = 0; i < kCount; ++i) {
    if (render_property(i).type == lang::Type::Word) add_word(command, i, overrides);
  }
  add_exposure(command, overrides);
  add_goals(command, overrides);
  add_instances(command, overrides.instancing);
}

void check_goals(const lang::Overrides& overrides, const lang::LoweredScene& lowered) {
  if (overrides.is_adaptive && overrides.is_denoised) {
    throw UsageError(
        "--adaptive and --denoise exclude each other: --adaptive chooses the samples for the error "
        "of the picture that is not denoised");
  }
  const bool is_plain = !lowered.camera;
  if (!overrides.is_adaptive || lowered.settings.error || is_plain) return;
  throw UsageError(
      overrides.seconds
          ? "--adaptive needs a requested error in addition to --time, such as "
            "--error 1%"
          : "--adaptive needs a requested error, such as --error 1%, or `error: 1%` in "
            "the scene's `render`");
}

}  // namespace sdlc::cli
