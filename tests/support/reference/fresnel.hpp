#pragma once

#include <cmath>

namespace sdlc::test::reference {

using namespace render;  // NOLINT

/// The share of reflected light by Schlick's approximation ("An inexpensive BRDF model for
/// physically-based rendering", 1994). `cosine` is the cosine of the incident angle on either side,
/// as in the JSON format's model; `eta` is the refractive index on the incident side divided by
/// that on the other side.
inline double fresnel_schlick(double cosine, double eta) noexcept {
  const double root = (1 - eta) / (1 + eta);
  const double straight = root * root;
  const double m = 1 - cosine;
  const double m2 = m * m;
  return straight + (1 - straight) * (m2 * m2 * m);
}

/// The share of unpolarised light that is reflected, by Fresnel's equations. Precondition: no total
/// reflection, eta² (1 − cosine²) ≤ 1.
inline double fresnel_exact(double cosine, double eta) noexcept {
  const double beyond = std::sqrt(std::fmax(0.0, 1 - eta * eta * (1 - cosine * cosine)));
  if (cosine + beyond == 0) return 1;  // grazing on both sides
  const double across = (eta * cosine - beyond) / (eta * cosine + beyond);
  const double along = (cosine - eta * beyond) / (cosine + eta * beyond);
  return 0.5 * (across * across + along * along);
}

}  // namespace sdlc::test::reference
