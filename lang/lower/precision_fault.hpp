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

/// A scene that the numbers it is to be traced in do not resolve.
struct PrecisionFault {
  /// A sphere that has a part in it, by its index.
  struct Role {
    std::uint32_t sphere;
    std::string label;
  };

  const DiagnosticInfo* info;  ///< beyond_double or beyond_precision
  std::string message;
  std::vector<Role> roles;  ///< the sphere that decides first; none where it is the view
  std::string help;
};

/// Whether `scene`, as `camera` sees it, reaches farther than double has digits for. Asking for
/// double waives that. O(n) time.
std::optional<PrecisionFault> find_scale_fault(const render::Scene& scene,
                                               const render::Camera& camera,
                                               std::optional<render::Precision> wanted);

/// What is wrong where a scene with these bounds is traced in the precision that they are of.
std::optional<PrecisionFault> find_bounds_fault(const render::PrecisionBounds& bounds,
                                                render::Precision precision);

/// Either, where the scene is traced in the precision that is asked for, or in that which suits it
/// best. O(n log n) time.
std::optional<PrecisionFault> find_precision_fault(const render::Scene& scene,
                                                   const render::Camera& camera,
                                                   const render::RenderSettings& settings,
                                                   std::optional<render::Precision> wanted);

/// Of how many cameras of a scene that is asked, the first ones, so that it takes .2 s.
std::size_t cameras_to_judge(std::size_t cameras, std::size_t spheres) noexcept;

}  // namespace sdlc::lang
