#pragma once

#include <algorithm>
#include <cmath>

#include "render/material/fresnel.hpp"
#include "render/math/sincos.hpp"
#include "render/math/vec3.hpp"
#include "render/sampler/sampler.hpp"
#include "render/scene/scene.hpp"

/// How a path goes on from a surface. Directions in and out have length 1; a surface that ends the
/// path is the integrator's affair.
namespace sdlc::render {

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

/// Uniform on the unit sphere. The radius of the circle of latitude comes from 2√(u(1 − u)), not
/// from √(1 − z²), which loses its digits at the poles. Turns begin at −x, where wide kernels save
/// an instruction.
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
  // Next to −n the sum has no digits left; probability 2.5e-13.
  return length_squared(direction) < 1e-12 ? facing : unit(direction);
}

/// The mirrored direction, moved within a ball of radius `fuzz`. What then points into the surface
/// is absorbed: false, and `out` is not set.
inline bool scatter_specular(Vec3 direction, Vec3 facing, double fuzz, const VertexSampler& sample,
                             Vec3& out) noexcept {
  Vec3 mirrored = reflect(direction, facing);
  if (fuzz > 1) {  // only the direction counts: divided by fuzz, it cannot overflow
    mirrored = mirrored / fuzz + sample_unit_ball(sample);
  } else if (fuzz > 0) {
    mirrored = mirrored + sample_unit_ball(sample) * fuzz;
  }
  if (!(dot(mirrored, facing) > 0)) return false;
  out = unit(mirrored);
  return true;
}

/// Reflects with the probability of the Fresnel term, else refracts by Snell's law. `outward` is
/// the sphere's outward normal; `ior` the index inside over the one outside.
inline Vec3 scatter_transmissive(Vec3 direction, Vec3 outward, double ior, Fresnel fresnel,
                                 const VertexSampler& sample) noexcept {
  const bool enters = dot(direction, outward) <= 0;
  const Vec3 facing = enters ? outward : -outward;
  const double eta = enters ? 1 / ior : ior;  // index on this side over the one beyond
  const double cosine = std::min(-dot(direction, facing), 1.0);
  const double sine_beyond_squared = eta * eta * (1 - cosine * cosine);
  // Total reflection; no number comes of an index whose inverse overflows, and of no sine.
  if (!(sine_beyond_squared <= 1)) return unit(reflect(direction, facing));

  const double reflected =
      fresnel == Fresnel::Schlick ? fresnel_schlick(cosine, eta) : fresnel_exact(cosine, eta);
  if (sample(kChoice).first < reflected) return unit(reflect(direction, facing));

  const Vec3 along = (direction + facing * cosine) * eta;
  return unit(along - facing * std::sqrt(std::fabs(1 - length_squared(along))));
}

}  // namespace sdlc::render
