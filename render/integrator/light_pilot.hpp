#pragma once

#include <cstdint>
#include <span>

#include "render/scene/scene.hpp"

namespace sdlc::render {

/// What connections to lights are worth, by 2048 paths: each relative to plain paths. They pay where
/// variance × work is below 1.
struct LightPilot {
  double variance = 1;            ///< of a path
  double work = 1;                ///< time of a path, by a model of rays and choices
  std::uint64_t connections = 0;  ///< that found their light; few of them prove nothing
};

/// Traces paths with connections to `lights`, always the same ones. It is not blind to light that
/// scattering hardly ever finds: what plain paths would do is computed from connections too
/// (PlainPaths). The scene is one without instances; it is copied and put into a hierarchy.
LightPilot run_light_pilot(Scene scene, const RenderSettings& settings,
                           std::span<const std::uint32_t> lights);

}  // namespace sdlc::render
