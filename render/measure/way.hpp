#pragma once

#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "render/scene/precision.hpp"
#include "render/scene/settings.hpp"

namespace sdlc::render {

/// A way to render a scene: the settings that a study varies, samples aside.
struct Way {
  SamplerKind sampler = SamplerKind::Sobol;
  LightSampling light_sampling = LightSampling::Auto;
  Precision precision = Precision::Float;  ///< that is taken; Mixed counts as asked for by Float
  int depth = 16;

  friend bool operator==(const Way&, const Way&) = default;
};

template <typename T>
struct WaySetting {
  std::string_view name, label;  ///< as in Setting
  T Way::*member;
  T RenderSettings::*setting;  ///< null: it is none of RenderSettings

  constexpr WaySetting(const Setting<T>& of, T Way::*member_)
      : name(of.name), label(of.label), member(member_), setting(of.member) {}
  constexpr WaySetting(std::string_view name_, T Way::*member_)
      : name(name_), member(member_), setting(nullptr) {}
};

inline constexpr std::tuple kWaySettings{
    WaySetting(kSampler, &Way::sampler), WaySetting(kLightSampling, &Way::light_sampling),
    WaySetting("precision", &Way::precision), WaySetting(kDepth, &Way::depth)};

/// Calls `visit(setting)` with each row of kWaySettings.
template <typename Visitor>
constexpr void for_each_way_setting(Visitor&& visit) {
  std::apply([&](const auto&... settings) { (visit(settings), ...); }, kWaySettings);
}

/// "sobol", "light sampling on", "float", "depth 16".
std::vector<std::string> parts_of(const Way& way);
/// The parts, with commas between them.
std::string describe(const Way& way);

}  // namespace sdlc::render
