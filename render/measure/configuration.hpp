#pragma once

#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "render/scene/settings.hpp"

namespace sdlc::render {

/// A way to render a scene: the settings that a study varies, samples aside.
struct Configuration {
  SamplerKind sampler = SamplerKind::Sobol;
  LightSampling light_sampling = LightSampling::Auto;
  Precision precision = Precision::Float;  ///< that is taken; Mixed counts as asked for by Float
  int depth = 16;
  bool is_denoised = false;

  friend bool operator==(const Configuration&, const Configuration&) = default;
};

template <typename T>
struct ConfigurationSetting {
  std::string_view name, label;  ///< as in Setting
  T Configuration::*member;
  T RenderSettings::*setting;  ///< null: it is none of RenderSettings

  constexpr ConfigurationSetting(const Setting<T>& of, T Configuration::*member_)
      : name(of.name), label(of.label), member(member_), setting(of.member) {}
  constexpr ConfigurationSetting(std::string_view name_, T Configuration::*member_)
      : name(name_), member(member_), setting(nullptr) {}
};

inline constexpr std::tuple kConfigurationSettings{
    ConfigurationSetting(kSampler, &Configuration::sampler),
    ConfigurationSetting(kLightSampling, &Configuration::light_sampling),
    ConfigurationSetting("precision", &Configuration::precision),
    ConfigurationSetting(kDepth, &Configuration::depth),
    ConfigurationSetting(kDenoise, &Configuration::is_denoised)};

/// Calls `visit(setting)` with each row of kConfigurationSettings.
template <typename Visitor>
constexpr void for_each_configuration_setting(Visitor&& visit) {
  std::apply([&](const auto&... settings) { (visit(settings), ...); }, kConfigurationSettings);
}

/// One per setting: "sobol", "light sampling on", "float", "depth 16", "denoised". Empty without a
/// filter.
std::vector<std::string> parts_of(const Configuration& configuration);
/// The parts that are not empty, with separators between them.
std::string join_parts(std::span<const std::string> parts, std::string_view separator = ", ");
std::string describe(const Configuration& configuration);

}  // namespace sdlc::render
