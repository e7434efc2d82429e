#pragma once

#include <cmath>
#include <limits>

#include "render/math/sincos.hpp"
#include "render/math/vec3.hpp"
#include "tests/support/reference/path_sampler.hpp"

/// The cone of directions in which a sphere is seen (Shirley, Wang, Zimmerman, "Monte Carlo
/// techniques for direct lighting calculations", 1996, 3.2).
namespace sdlc::test::reference {

using namespace render;  // NOLINT

/// From this sin² of the half angle on, the light fills two thirds of the sky or contains the
/// point: scattering finds it anyway.
inline constexpr double kLargestLightSine2 = 0.9;

struct LightCone {
  Vec3 to_center;
  double distance = 0;  ///< to the centre
  /// 1 − cos of the half angle; the solid angle is 2π times this. 0 means that there is no cone to
  /// sample.
  double height = 0;
};

inline LightCone light_cone(Vec3 to_center, double radius) noexcept {
  const double distance_squared = dot(to_center, to_center);
  const double sine_squared = radius * radius / distance_squared;
  if (!(sine_squared < kLargestLightSine2)) return {};
  // 1 − √(1 − s) would cancel for small lights.
  return {to_center, std::sqrt(distance_squared), sine_squared / (1 + std::sqrt(1 - sine_squared))};
}

/// A direction that is uniform in the cone, and the distance to the sphere along it.
struct LightDirection {
  Vec3 direction;
  double distance = 0;
};

inline LightDirection sample_cone(const LightCone& cone, double radius,
                                  UniformPair random) noexcept {
  const double below = random.first * cone.height;  // 1 − cos θ
  const double cosine = 1 - below, sine_squared = below * (2 - below);
  // With z as the axis; two perpendicular directions by Duff et al., "Building an orthonormal
  // basis, revisited", 2017.
  const Vec3 z = cone.to_center / cone.distance;
  const double sign = std::copysign(1.0, z.z);
  const double a = -1 / (sign + z.z), b = z.x * z.y * a;
  const Vec3 x{1 + sign * z.x * z.x * a, sign * b, -sign * z.x};
  const Vec3 y{b, sign + z.y * z.y * a, -z.y};
  const double sine = std::sqrt(sine_squared);
  const SinCos around = sincos_turns(random.second);
  const Vec3 direction = z * cosine + x * (-sine * around.cos) + y * (-sine * around.sin);
  const double across_squared = cone.distance * cone.distance * sine_squared;
  const double half_chord = std::sqrt(std::fmax(radius * radius - across_squared, 0.0));
  return {direction, cone.distance * cosine - half_chord};
}

/// The balance heuristic (Veach, "Robust Monte Carlo methods for light transport simulation", 1997,
/// 9.2.2) for scattering, with a density times π of `scattering`, versus sampling the light (chosen
/// with this probability, with a direction in its cone). A scattered ray that hits the light has
/// this weight. A connection also counts as its radiance times this: the weight of its own
/// technique times the density of scattering over its own is the same number.
inline double scattering_weight(double probability, const LightCone& cone,
                                double scattering) noexcept {
  if (!(probability > 0 && cone.height > 0)) return 1;
  const double scattered = 2 * cone.height * scattering;
  return scattered / (probability + scattered);
}

}  // namespace sdlc::test::reference
