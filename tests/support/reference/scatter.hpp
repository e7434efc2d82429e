#pragma once

#include <algorithm>
#include <cmath>

#include "render/math/sincos.hpp"
#include "render/math/vec3.hpp"
#include "render/scene/scene.hpp"
#include "render/shading/sampler.hpp"
#include "tests/support/reference/fresnel.hpp"
#include "tests/support/reference/path_sampler.hpp"

/// Scattering at surfaces. Directions in and out have length 1. Surfaces that end the path are
/// handled by the integrator.
namespace sdlc::test::reference {

using namespace render;  // NOLINT

/// The random numbers of one vertex of a path.
class VertexSampler {
 public:
  VertexSampler(const PathSampler& path, int vertex) noexcept : path_(path), vertex_(vertex) {}
  UniformPair operator()(VertexPair pair) const noexcept {
    return path_.pair(vertex_pair(vertex_, pair));
  }

 private:
  const PathSampler& path_;
  int vertex_;
};

/// Uniform on the unit sphere. The radius of the circle of latitude is 2√(u(1 − u)), not √(1 − z²),
/// which loses its digits at the poles. Angles start at −x.
inline Vec3 sample_unit_sphere(const VertexSampler& sample) noexcept {
  const auto [u, turn] = sample(kDirection);
  const SinCos around = sincos_turns(turn);
  const double circle = 2 * std::sqrt(u * (1 - u));
  return {-circle * around.cos, -circle * around.sin, 1 - 2 * u};
}

/// Uniform in the unit ball.
inline Vec3 sample_unit_ball(const VertexSampler& sample) noexcept {
  return sample_unit_sphere(sample) * std::cbrt(sample(kChoice).first);
}

inline Vec3 reflect(Vec3 direction, Vec3 normal) noexcept {
  return direction - normal * (2 * dot(direction, normal));
}

/// Cosine law: the normal plus a uniform unit vector. `facing` is the normal on the side of the
/// incoming ray.
inline Vec3 scatter_diffuse(Vec3 facing, const VertexSampler& sample) noexcept {
  const Vec3 direction = facing + sample_unit_sphere(sample);
  // Near −n the sum has no digits left; probability 2.5e-13.
  return length_squared(direction) < 1e-12 ? facing : unit(direction);
}

/// The mirrored direction, perturbed within a ball of radius `fuzz`. A result that points into the
/// surface is absorbed: returns false and does not set `out`.
inline bool scatter_specular(Vec3 direction, Vec3 facing, double fuzz, const VertexSampler& sample,
                             Vec3& out) noexcept {
  Vec3 mirrored = reflect(direction, facing);
  if (fuzz > 1) {  // divided by fuzz, so that it cannot overflow; only the direction matters
    mirrored = mirrored / fuzz + sample_unit_ball(sample);
  } else if (fuzz > 0) {
    mirrored = mirrored + sample_unit_ball(sample) * fuzz;
  }
  if (!(dot(mirrored, facing) > 0)) return false;
  out = unit(mirrored);
  return true;
}

/// π times the density of the directions that scatter_specular() gives, absorbed ones included.
/// They are those of points in a ball of radius `fuzz` around `mirrored`; a direction has the
/// density ∫ r² dr along its chord of the ball, divided by the volume.
inline double metal_density(Vec3 mirrored, double fuzz, Vec3 direction) noexcept {
  const double cosine = dot(mirrored, direction), sine = length(cross(mirrored, direction));
  if (!(sine < fuzz)) return 0;
  const double half_chord = std::sqrt((fuzz - sine) * (fuzz + sine));
  const double end = cosine + half_chord, start = std::fmax(cosine - half_chord, 0);
  if (!(end > 0)) return 0;
  const double cubes = (end - start) * (end * end + end * start + start * start);
  return cubes / 4 / (fuzz * fuzz * fuzz);
}

/// Reflects with the probability of the Fresnel term, otherwise refracts by Snell's law. `outward`
/// is the sphere's outward normal; `ior` the index inside divided by the one outside.
inline Vec3 scatter_transmissive(Vec3 direction, Vec3 outward, double ior, Fresnel fresnel,
                                 const VertexSampler& sample) noexcept {
  const bool enters = dot(direction, outward) <= 0;
  const Vec3 facing = enters ? outward : -outward;
  const double eta = enters ? 1 / ior : ior;  // index on this side divided by that on the other
                                              // side
  const double cosine = std::min(-dot(direction, facing), 1.0);
  const double sine_beyond_squared = eta * eta * (1 - cosine * cosine);
  // Total reflection. The negated comparison includes NaN, from an index whose inverse overflows.
  if (!(sine_beyond_squared <= 1)) return unit(reflect(direction, facing));

  const double reflected =
      fresnel == Fresnel::Schlick ? fresnel_schlick(cosine, eta) : fresnel_exact(cosine, eta);
  if (sample(kChoice).first < reflected) return unit(reflect(direction, facing));

  const Vec3 along = (direction + facing * cosine) * eta;
  return unit(along - facing * std::sqrt(std::fabs(1 - length_squared(along))));
}

}  // namespace sdlc::test::reference
