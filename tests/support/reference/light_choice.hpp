#pragma once

#include <cstdint>
#include <optional>

#include "render/math/color.hpp"
#include "render/math/vec3.hpp"
#include "render/shading/lights.hpp"
#include "tests/support/reference/path_sampler.hpp"
#include "tests/support/reference/scatter.hpp"

namespace sdlc::test::reference {

using namespace render;  // NOLINT

struct LightChoice {
  std::uint32_t leaf = 0;
  double probability = 0;  ///< 0: no light
};
/// Chooses one of the lights for the point `x`, which light reaches only on the side of the unit
/// vector `normal`.
LightChoice choose_light(const LightTree& tree, Vec3 x, Vec3 normal, UniformPair random) noexcept;
/// LightChoice::probability of a leaf.
double probability_of(const LightTree& tree, std::uint32_t leaf, Vec3 x, Vec3 normal) noexcept;

/// A point on a diffuse surface or metal. `normal` is on the side from which the path came.
struct LitPlace {
  Vec3 x, normal;
  double u = 0;     ///< time within the shutter
  Vec3 mirrored;    ///< by metal, of length 1
  double fuzz = 0;  ///< of metal; 0: diffuse

  /// π times the density of scattering into a direction; `cosine` is that to the normal.
  double scattering(Vec3 direction, double cosine) const noexcept {
    return fuzz > 0 ? metal_density(mirrored, fuzz, direction) : cosine;
  }
};
/// A shadow ray towards a light.
struct Connection {
  Vec3 direction;
  double distance = 0;   ///< an occluder is nearer than this
  LinearRgb radiance;    ///< contribution if unoccluded, without the attenuation of the surface
  std::uint32_t sphere;  ///< the light
};
/// nullopt if no light can be visible.
std::optional<Connection> connect(const Lights& lights, const LitPlace& at, UniformPair choice,
                                  UniformPair direction) noexcept;
/// The weight of a ray scattered there into a direction that hits the sphere.
double weight_of_hit(const Lights& lights, std::uint32_t sphere, const LitPlace& at,
                     Vec3 direction) noexcept;

}  // namespace sdlc::test::reference
