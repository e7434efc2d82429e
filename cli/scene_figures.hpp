#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "render/math/vec3.hpp"
#include "render/scene/scene.hpp"
#include "render/tiles/kernel.hpp"

/// Figures about a scene, each from one pass over its spheres.
namespace sdlc::cli {

/// The type as the language writes it.
std::string_view material_name(render::MaterialType type) noexcept;

/// How much of a scene is of one type of material.
struct MaterialFigures {
  render::MaterialType type;
  std::size_t materials = 0;  ///< distinct ones that a sphere has
  std::uint64_t spheres = 0;
};

/// One row for each type, in a fixed order.
using MaterialCounts = std::array<MaterialFigures, 5>;
MaterialCounts count_materials(const render::Scene& scene);

/// What this scene asks of the renderer: "motion", "gradient" and the material types it uses, in a
/// fixed order.
std::vector<std::string> required_features(const render::Scene& scene,
                                           const MaterialCounts& materials);

/// Where the spheres are and how large. Lengths may be infinite where a double cannot hold them.
struct SphereFigures {
  /// A sphere by its index in the scene.
  struct Radius {
    std::optional<std::uint32_t> sphere;  ///< nothing: one of an instance
    double radius = 0;
  };

  /// Corners of the box around all spheres, over the whole shutter; of balls around instances.
  render::Vec3 low, high;
  Radius smallest, largest;  ///< of several the first
  double extent = 0;         ///< from the camera to the far side of the farthest sphere
  std::uint64_t moving = 0;

  double radius_ratio() const noexcept { return largest.radius / smallest.radius; }
  /// What the precision of numbers has to span.
  double scale_ratio() const noexcept { return extent / smallest.radius; }
};

/// Nothing for a scene without spheres.
std::optional<SphereFigures> measure_spheres(const render::Scene& scene);

/// Bytes that a scene and its picture take.
struct MemoryFigures {
  std::size_t spheres = 0, motion = 0, instances = 0, materials = 0;
  std::size_t bvh = 0;  ///< estimated: nothing is built
  std::size_t picture = 0;

  std::size_t total() const noexcept {
    return spheres + motion + instances + materials + bvh + picture;
  }
  /// What each sphere takes.
  double per_sphere(std::uint64_t count) const noexcept {
    return static_cast<double>(spheres + motion + instances + bvh) / static_cast<double>(count);
  }
};

MemoryFigures estimate_memory(const render::Scene& scene, const render::RenderSettings& settings,
                              const render::Kernel& kernel);

}  // namespace sdlc::cli
