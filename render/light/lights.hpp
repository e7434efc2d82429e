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

/// A sphere that diffuse surfaces look for by themselves.
struct Light {
  Vec3 center;  ///< at the opening of the shutter
  Vec3 shift;   ///< up to its closing
  double radius = 0;
  LinearRgb radiance;
  std::uint32_t sphere = kNoLight;  ///< index in the scene; kNoLight: a leaf of the tree to spare

  Vec3 center_at(double u) const noexcept { return center + shift * u; }
};

/// The emissive spheres for which diffuse surfaces take directions of their own, beside those in
/// which they scatter, and how much of the light each of the two techniques accounts for. The two
/// together have the expectation of scattering alone, path length by path length.
class Lights {
 public:
  Lights() = default;
  /// `scene` is rebased; `spheres` are emissive ones of it, as choose_lights() chooses them.
  Lights(const Scene& scene, std::span<const std::uint32_t> spheres);

  bool empty() const noexcept { return leaves_.empty(); }
  const LightTree& tree() const noexcept { return tree_; }
  const std::vector<Light>& leaves() const noexcept { return leaves_; }  ///< as the tree has them
  /// The leaf of a sphere, or kNoLight.
  std::uint32_t leaf_of(std::uint32_t sphere) const noexcept;

  /// A place on a diffuse surface. `normal` is on the side from which the path came.
  struct Place {
    Vec3 x, normal;
    double u = 0;  ///< in the shutter
  };
  /// A ray that may find a light.
  struct Connection {
    Vec3 direction;
    double distance = 0;   ///< what it meets before that hides the light
    LinearRgb radiance;    ///< what it brings, times the attenuation of the surface
    double weight = 0;     ///< the part of the light's radiance that this is
    std::uint32_t sphere;  ///< the light
  };
  /// Nothing where no light may be seen.
  std::optional<Connection> connect(const Place& at, UniformPair choice,
                                    UniformPair direction) const noexcept;
  /// Of a ray scattered there, with `cosine` to the normal, that hits a sphere.
  double weight_of_hit(std::uint32_t sphere, const Place& at, double cosine) const noexcept;

 private:
  LightTree tree_;
  std::vector<Light> leaves_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> leaves_of_spheres_;  // sorted
};

}  // namespace sdlc::render
