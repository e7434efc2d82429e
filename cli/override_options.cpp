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

#include "cli/whole_number.hpp"
#include "cli/words.hpp"
#include "lang/object/object.hpp"
#include "lang/schema/schema.hpp"

namespace sdlc::cli {
namespace {

const lang::Property& render_property(std::size_t index) {
  return lang::kind_info(lang::ObjectKind::Render).properties[index];
}

/// A flag for a property that is a word or a name.
void add_override(CLI::App& command, std::size_t index, std::optional<std::string>& value) {
  const lang::Property& property = render_property(index);
  CLI::Option* option =
      command.add_option(fmt::format("--{}", property.name), value, std::string(property.doc));
  if (!property.words.empty()) option->check(one_of(property.words));
}

/// A flag for a property that is a whole number.
template <typename T>
void add_override(CLI::App& command, std::size_t index, std::optional<T>& value) {
  const lang::Property& property = render_property(index);
  WholeNumbers range{.lowest = property.range == lang::Range::AtLeastOne ? 1u : 0u};
  if (std::is_same_v<T, int>) range.highest = static_cast<std::uint64_t>(lang::kMaxWholeNumber);
  add_whole_number(
      command, fmt::format("--{}", property.name), range,
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
  add_instances(command, overrides.instancing);
}

}  // namespace sdlc::cli
