#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

#include "render/math/vec3.hpp"
#include "tests/support/reference/ray.hpp"

/// Ray-sphere intersection without any epsilon.
namespace sdlc::test::reference {

using namespace render;  // NOLINT

inline constexpr double kNoHit = std::numeric_limits<double>::infinity();
inline constexpr std::uint32_t kNoSphere = 0xFFFFFFFF;

/// Distance along a unit direction to the first point of a sphere with t > 0, or kNoHit. `f` is the
/// ray's origin minus the centre.
///
/// Hit or miss is decided by the component of `f` perpendicular to the direction, not by a
/// difference of two squares: its error grows as distance / radius, where that of the textbook
/// discriminant grows as its square (Haines, Günther, Akenine-Möller, "Precision Improvements for
/// Ray/Sphere Intersection", Ray Tracing Gems, ch. 7). The root without cancellation is computed
/// first; the other follows from the product of the two.
inline double hit_distance(Vec3 f, Vec3 direction, double radius) noexcept {
  const double b = dot(f, direction);
  const Vec3 across = f - direction * b;
  const double discriminant = radius * radius - dot(across, across);
  if (discriminant < 0) return kNoHit;

  const double c = dot(f, f) - radius * radius;  // > 0: the origin is outside
  const double s = std::fabs(b) + std::sqrt(discriminant);
  if (b < 0) return c > 0 ? c / s : s;
  return c < 0 ? -c / s : kNoHit;
}

/// The surface that a ray starts on. A ray that leaves a sphere hits it again only from inside, at
/// a distance with a closed form. `normal` is the outward normal at the start.
struct Departure {
  std::uint32_t sphere = kNoSphere;
  Vec3 normal;
};

/// The distance at which a ray that starts on a sphere hits the same sphere again, or kNoHit.
inline double rehit_distance(Vec3 direction, Vec3 normal, double radius) noexcept {
  const double cosine = dot(direction, normal);
  return cosine < 0 ? -2 * cosine * radius : kNoHit;
}

/// The outward normal at that hit. It is normalised every time: otherwise the error would grow
/// without bound over many internal reflections.
inline Vec3 rehit_normal(Vec3 direction, Vec3 normal) noexcept {
  return unit(normal - direction * (2 * dot(direction, normal)));
}

}  // namespace sdlc::test::reference
