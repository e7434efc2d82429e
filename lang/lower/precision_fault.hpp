#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lang/diagnostics/diagnostics.hpp"
#include "render/exactness/precision.hpp"
#include "render/scene/scene.hpp"

namespace sdlc::lang {

/// The reason why a precision does not resolve a scene.
struct PrecisionFault {
  /// A sphere that contributes to it.
  struct Role {
    std::uint32_t sphere;
    std::string label;
  };

  const DiagnosticInfo* info;  ///< beyond_double or beyond_precision
  std::string message;
  std::vector<Role> roles;  ///< the deciding sphere first; empty if it is the view
  std::string help;
};

/// The fault if the scales of the scene, as seen from `camera`, are too far apart for double;
/// nullopt if double is requested explicitly. O(n) time.
std::optional<PrecisionFault> find_scale_fault(const render::Scene& scene,
                                               const render::Camera& camera,
                                               std::optional<render::Precision> wanted);

/// The fault if the bounds, which are those of `precision`, are exceeded.
std::optional<PrecisionFault> find_bounds_fault(const render::PrecisionBounds& bounds,
                                                render::Precision precision);

/// Either fault, for the wanted precision or, without one, for double. O(n log n) time.
std::optional<PrecisionFault> find_precision_fault(const render::Scene& scene,
                                                   const render::Camera& camera,
                                                   const render::RenderSettings& settings,
                                                   std::optional<render::Precision> wanted);

/// How many cameras of a scene can be judged within 0.2 s.
std::size_t cameras_to_judge(std::size_t cameras, std::size_t spheres) noexcept;

}  // namespace sdlc::lang
