#pragma once

#include <cstdint>
#include <span>

#include "render/scene/scene.hpp"

namespace sdlc::render {

/// With fewer connections of a technique, its estimated value is unreliable.
inline constexpr std::uint64_t kMinConnections = 30;

/// The estimated value of connections to lights, relative to plain paths. Connections pay off if
/// variance × work < 1.
struct LightPilot {
  struct Cost {
    double variance = 1;  ///< per path
    double work = 1;      ///< time per path, from a model of rays and choices

    double product() const noexcept { return variance * work; }
  };
  /// Whether connections from rough metal pay; by is_metal_rough_for() if there are few. Those that
  /// do not are left out of the costs.
  bool samples_at_metal = true;
  Cost direct;                    ///< without casters
  Cost with_casters;              ///< with them
  std::uint64_t connections = 0;  ///< unoccluded ones
  std::uint64_t caustics = 0;     ///< those by way of casters
};

/// Traces 8192 paths with connections to `lights`, also by way of `casters`; the paths are always
/// the same, and so is the kernel, portable_kernel, on every machine. Light that scattering almost
/// never finds is included, because the result of plain paths is computed from connections too
/// (PlainPaths). The scene must have no instances; it is copied and gets its own BVH.
LightPilot run_light_pilot(Scene scene, const RenderSettings& settings,
                           std::span<const std::uint32_t> lights,
                           std::span<const std::uint32_t> casters);

}  // namespace sdlc::render
