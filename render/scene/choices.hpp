#pragma once

#include <array>
#include <string_view>

#include "render/scene/scene.hpp"

namespace sdlc::render {

inline constexpr std::array kSamplerKinds{SamplerKind::Sobol, SamplerKind::Independent};
inline constexpr std::array kLightSamplings{LightSampling::Auto, LightSampling::On,
                                            LightSampling::Off};

/// The word for it: "sobol" or "independent".
std::string_view name_of(SamplerKind sampler) noexcept;

/// The word for it: "auto", "on" or "off".
std::string_view name_of(LightSampling lights) noexcept;

}  // namespace sdlc::render
