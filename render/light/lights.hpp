#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "render/light/light_tree.hpp"
#include "render/math/color.hpp"
#include "render/math/vec3.hpp"
#include "render/sampler/sampler.hpp"
#include "render/scene/scene.hpp"

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

/// The emissive spheres that diffuse surfaces sample directly, in addition to scattering, and the
/// weight of the two techniques (multiple importance sampling). Their combination has the same
/// expectation as scattering alone, path length by path length.
class Lights {
 public:
  Lights() = default;
  /// `scene` is rebased; `spheres` are its emissive spheres from choose_lights().
  Lights(const Scene& scene, std::span<const std::uint32_t> spheres);

  bool empty() const noexcept { return leaves_.empty(); }
  const LightTree& tree() const noexcept { return tree_; }
  const std::vector<Light>& leaves() const noexcept {
    return leaves_;
  }  ///< in the order of the tree
  /// The leaf of a sphere, or kNoLight.
  std::uint32_t leaf_of(std::uint32_t sphere) const noexcept;

  /// A point on a diffuse surface. `normal` is on the side from which the path came.
  struct Place {
    Vec3 x, normal;
    double u = 0;  ///< time within the shutter
  };
  /// A shadow ray towards a light.
  struct Connection {
    Vec3 direction;
    double distance = 0;   ///< an occluder is nearer than this
    LinearRgb radiance;    ///< contribution if unoccluded, times the attenuation of the surface
    double weight = 0;     ///< share of the light's radiance in this contribution
    std::uint32_t sphere;  ///< the light
  };
  /// nullopt if no light can be visible.
  std::optional<Connection> connect(const Place& at, UniformPair choice,
                                    UniformPair direction) const noexcept;
  /// The weight of a ray scattered there, with `cosine` to the normal, that hits the sphere.
  double weight_of_hit(std::uint32_t sphere, const Place& at, double cosine) const noexcept;

 private:
  LightTree tree_;
  std::vector<Light> leaves_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> leaves_of_spheres_;  // sorted
};

}  // namespace sdlc::render
