#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "render/math/color.hpp"
#include "render/math/vec3.hpp"
#include "render/scene/scene.hpp"
#include "render/shading/light_tree.hpp"

namespace sdlc::render {

/// A sphere that diffuse surfaces sample directly.
struct Light {
  Vec3 center;  ///< at shutter opening
  Vec3 shift;   ///< displacement until the shutter closes
  double radius = 0;
  LinearRgb radiance;
  std::uint32_t sphere = kNoLight;  ///< index in the scene; kNoLight for an unused leaf of the tree

  Vec3 center_at(double u) const noexcept { return center + shift * u; }
};

/// The emissive spheres that diffuse surfaces sample directly, in addition to scattering (multiple
/// importance sampling). The combination has the same expectation as scattering alone, path length
/// by path length.
class Lights {
 public:
  Lights() = default;
  /// `scene` is rebased; `spheres` are its emissive spheres from choose_lights().
  Lights(const Scene& scene, std::span<const std::uint32_t> spheres);
  /// Spheres from choose_casters(), which pass on the light of others: their colour takes the place
  /// of radiance, their area that of power.
  static Lights casters(const Scene& scene, std::span<const std::uint32_t> spheres);

  bool empty() const noexcept { return leaves_.empty(); }
  const LightTree& tree() const noexcept { return tree_; }
  const std::vector<Light>& leaves() const noexcept {
    return leaves_;
  }  ///< in the order of the tree
  /// The leaf of a sphere, or kNoLight.
  std::uint32_t leaf_of(std::uint32_t sphere) const noexcept;

 private:
  /// `powers`: of `lights`, relative to each other.
  Lights(const std::vector<Light>& lights, std::span<const double> powers);

  LightTree tree_;
  std::vector<Light> leaves_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> leaves_of_spheres_;  // sorted
};

}  // namespace sdlc::render
