#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lang/diagnostics/diagnostics.hpp"
#include "render/scene/precision.hpp"
#include "render/scene/scene.hpp"

namespace sdlc::lang {

/// A scene that its precision does not resolve.
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

/// The fault of a scene whose scales, as `camera` sees it, are too far apart for double; none if
/// double is asked for explicitly. O(n) time.
std::optional<PrecisionFault> find_scale_fault(const render::Scene& scene,
                                               const render::Camera& camera,
                                               std::optional<render::Precision> wanted);

/// The fault of a scene with these bounds, which are those of `precision`.
std::optional<PrecisionFault> find_bounds_fault(const render::PrecisionBounds& bounds,
                                                render::Precision precision);

/// Either fault, with the precision that is asked for or, without one, with the best. O(n log n)
/// time.
std::optional<PrecisionFault> find_precision_fault(const render::Scene& scene,
                                                   const render::Camera& camera,
                                                   const render::RenderSettings& settings,
                                                   std::optional<render::Precision> wanted);

/// How many of the first cameras of a scene to judge, so that it takes at most 0.2 s.
std::size_t cameras_to_judge(std::size_t cameras, std::size_t spheres) noexcept;

}  // namespace sdlc::lang
