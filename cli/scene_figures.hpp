#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "render/kernel/kernel.hpp"
#include "render/math/vec3.hpp"
#include "render/scene/scene.hpp"

/// Figures about a scene, each from one pass over its spheres.
namespace sdlc::cli {

/// The type in the spelling of the language.
std::string_view material_name(render::MaterialType type) noexcept;

/// Statistics of one type of material.
struct MaterialFigures {
  render::MaterialType type;
  std::size_t materials = 0;  ///< distinct materials in use
  std::uint64_t spheres = 0;
};

/// One row per type, in a fixed order.
using MaterialCounts = std::array<MaterialFigures, 5>;
MaterialCounts count_materials(const render::Scene& scene);

/// The renderer features that a scene uses: "motion", "lens", "gradient" and its material types, in
/// a fixed order.
std::vector<std::string> required_features(const render::Scene& scene,
                                           const MaterialCounts& materials);

/// Position and size of the spheres. Lengths may be infinite if a double cannot hold them.
struct SphereFigures {
  /// A sphere by its index in the scene.
  struct Radius {
    std::optional<std::uint32_t> sphere;  ///< nullopt for a sphere of an instance
    double radius = 0;
  };

  /// Corners of the bounding box of all spheres, over the whole shutter; for instances, of their
  /// bounding spheres.
  render::Vec3 low, high;
  Radius smallest, largest;  ///< the first one if there are several
  double extent = 0;         ///< from the camera to the far side of the farthest sphere
  std::uint64_t moving = 0;

  double radius_ratio() const noexcept { return largest.radius / smallest.radius; }
  /// The range that the precision has to resolve.
  double scale_ratio() const noexcept { return extent / smallest.radius; }
};

/// nullopt for a scene without spheres.
std::optional<SphereFigures> measure_spheres(const render::Scene& scene);

/// Memory of a scene and its picture, in bytes.
struct MemoryFigures {
  std::size_t spheres = 0, motion = 0, instances = 0, materials = 0;
  std::size_t bvh = 0;  ///< estimated, without building it
  std::size_t picture = 0;

  std::size_t total() const noexcept {
    return spheres + motion + instances + materials + bvh + picture;
  }
  /// Bytes per sphere.
  double per_sphere(std::uint64_t count) const noexcept {
    return static_cast<double>(spheres + motion + instances + bvh) / static_cast<double>(count);
  }
};

MemoryFigures estimate_memory(const render::Scene& scene, const render::RenderSettings& settings,
                              const render::Kernel& kernel);

}  // namespace sdlc::cli
