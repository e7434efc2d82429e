#pragma once

#include <cstdint>
#include <span>

#include "render/scene/scene.hpp"

namespace sdlc::render {

/// The estimated value of connections to lights, relative to plain paths. Connections pay off if
/// variance × work < 1.
struct LightPilot {
  double variance = 1;            ///< variance per path
  double work = 1;                ///< time per path, from a model of rays and light choices
  std::uint64_t connections = 0;  ///< unoccluded ones; the estimates are unreliable if there are
                                  ///< few
};

/// Traces 2048 paths with connections to `lights`; the paths are always the same, and so is the
/// kernel, portable_kernel, on every machine. Light that scattering almost never finds is included,
/// because the result of plain paths is computed from connections too (PlainPaths). The scene must
/// have no instances; it is copied and gets its own BVH.
LightPilot run_light_pilot(Scene scene, const RenderSettings& settings,
                           std::span<const std::uint32_t> lights);

}  // namespace sdlc::render
