#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>

#include "render/scene/scene.hpp"

/// The table of render settings. A row gives a member of RenderSettings its name: that of the
/// property of `render`, of the key in JSON, CSV and metadata and, with `-` for `_`, of the flag.
namespace sdlc::render {

/// The words for the values of an enumeration, in the order of its enumerators.
template <typename T>
inline constexpr auto kWords = std::array<std::string_view, 0>{};
template <>
inline constexpr auto kWords<SamplerKind> = std::to_array<std::string_view>({"sobol",
                                                                             "independent"});
template <>
inline constexpr auto kWords<LightSampling> = std::to_array<std::string_view>({"auto", "on", "off",
                                                                               "caustics"});
template <>
inline constexpr auto kWords<Precision> = std::to_array<std::string_view>({"float", "mixed",
                                                                           "double"});

/// An enumeration whose values have words.
template <typename T>
concept Choice = std::is_enum_v<T> && !kWords<T>.empty();

template <Choice T>
constexpr std::string_view name_of(T value) noexcept {
  return kWords<T>[static_cast<std::size_t>(value)];
}

/// The value of this name; nullopt if there is none.
template <Choice T>
constexpr std::optional<T> choice_named(std::string_view word) noexcept {
  for (std::size_t i = 0; i < kWords<T>.size(); ++i) {
    if (kWords<T>[i] == word) return static_cast<T>(i);
  }
  return std::nullopt;
}

/// A value as JSON and reports show it: the word of a choice, any other value as it is.
template <typename T>
constexpr auto shown(T value) noexcept {
  if constexpr (Choice<T>) {
    return name_of(value);
  } else {
    return value;
  }
}

template <typename T>
struct Setting {
  std::string_view name;
  std::string_view label;  ///< before the value in prose; empty: the value is clear by itself
  T RenderSettings::*member;
};
template <typename T>
Setting(std::string_view, std::string_view, T RenderSettings::*) -> Setting<T>;

inline constexpr Setting kDepth{"depth", "depth", &RenderSettings::depth};
inline constexpr Setting kSeed{"seed", "seed", &RenderSettings::seed};
inline constexpr Setting kSampler{"sampler", "", &RenderSettings::sampler};
inline constexpr Setting kLightSampling{"light_sampling", "light sampling",
                                        &RenderSettings::light_sampling};

/// Not of kSettings, as it changes no path.
inline constexpr Setting kDenoise{"denoise", "", &RenderSettings::is_denoised};

/// The settings that decide on paths and are read, set and reported like any other. Those that need
/// more than that (size, samples and goals, threads) are not here.
inline constexpr std::tuple kSettings{kDepth, kSeed, kSampler, kLightSampling};

/// Calls `visit(setting)` with each row of kSettings.
template <typename Visitor>
constexpr void for_each_setting(Visitor&& visit) {
  std::apply([&](const auto&... settings) { (visit(settings), ...); }, kSettings);
}

/// `--light-sampling` of `light_sampling`.
std::string flag_of(std::string_view setting);

}  // namespace sdlc::render
