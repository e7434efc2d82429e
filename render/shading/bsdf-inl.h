// The scattering of light by materials. Compiled once per instruction set, so it has no include
// guard but Highway's.
// clang-format off
#if defined(SDLC_RENDER_SHADING_BSDF_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SDLC_RENDER_SHADING_BSDF_INL_H
#undef SDLC_RENDER_SHADING_BSDF_INL_H
#else
#define SDLC_RENDER_SHADING_BSDF_INL_H
#endif
// clang-format on

#include <cstdint>

#include <hwy/highway.h>

#include "render/lanes/table_reader-inl.h"
#include "render/lanes/vector_math-inl.h"
#include "render/shading/lane_sampler-inl.h"
#include "render/shading/optics.hpp"
#include "render/shading/sampler.hpp"

HWY_BEFORE_NAMESPACE();
namespace sdlc::render::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Samples the scattering at surfaces, whose optics `read_optics` looks up.
template <typename T>
class Bsdf {
 public:
  using D = Lanes<T>;
  using DU = hn::RebindToUnsigned<D>;
  using V = hn::Vec<D>;
  using Bits = hn::Vec<DU>;
  using Mask = hn::Mask<D>;

  struct Sample {
    Triple<V> direction;  ///< of any length; undefined where the path ends
    Mask absorbed;
    Mask reflected;  ///< kRefracts: not refracted
    V reflectance;   ///< kRefracts: the probability of reflection
  };
  /// What happens to light at the boundary of glass.
  struct Boundary {
    Triple<V> refracted;
    V reflectance;  ///< 1 for total reflection
  };

  HWY_INLINE Bsdf(const OpticsColumns<T>& columns, const TableReader<D>& read_optics)
      : columns_(columns), read_(read_optics) {}

  static HWY_INLINE Mask has(Bits surface, SurfaceBit bit) {
    return hn::RebindMask(D(), hn::TestBit(surface, hn::Set(DU(), std::uint32_t{bit})));
  }

  static HWY_INLINE Mask is_diffuse(Bits surface) {
    const Bits others = hn::Set(DU(), std::uint32_t{kEndsPath | kMirrors | kRefracts});
    return hn::RebindMask(D(), hn::Eq(hn::And(surface, others), hn::Zero(DU())));
  }

  /// Diffuse, or wide metal that samples lights.
  static HWY_INLINE Mask is_wide(Bits surface) {
    return hn::Or(is_diffuse(surface), has(surface, kIsWide));
  }

  HWY_INLINE Sample sample(Triple<V> direction, Triple<V> outward, V cosine, Bits surface,
                           const LaneSampler<D>& sampler) const;
  /// `facing`: the normal on the side of the ray; `cosine` as for sample().
  HWY_INLINE Boundary boundary(Triple<V> direction, Triple<V> facing, V cosine, Bits surface) const;
  /// π times the probability density, per solid angle, of scattering at fuzzy metal from the
  /// mirrored direction to `next`, both of length 1; absorbed directions included. For diffuse
  /// surfaces the same quantity is the cosine.
  HWY_INLINE V metal_density(Triple<V> mirrored, Triple<V> next) const;

 private:
  static HWY_INLINE V set(double v) { return hn::Set(D(), static_cast<T>(v)); }

  const OpticsColumns<T>& columns_;
  const TableReader<D>& read_;
};

/// `outward` is the normal; `cosine` is of `direction` and `outward`; `surface` holds SurfaceBits,
/// 0 without a hit.
template <typename T>
HWY_INLINE auto Bsdf<T>::sample(Triple<V> direction, Triple<V> outward, V cosine, Bits surface,
                                const LaneSampler<D>& sampler) const -> Sample {
  const D d;
  const V one = set(1);
  // The normal on the side of the ray: flipped if the cosine is positive.
  const Triple<V> facing = flipped(outward, hn::AndNot(cosine, hn::SignBit(d)));

  const auto [u, turn] = sampler.pair(kDirection);
  const V circle = hn::Sqrt(hn::Mul(u, hn::Sub(one, u)));
  Triple<V> on_sphere;  // on the unit sphere
  point_on_circle(turn, hn::Add(circle, circle), on_sphere.x, on_sphere.y);
  on_sphere.z = hn::NegMulAdd(set(2), u, one);

  Triple<V> next{hn::Add(facing.x, on_sphere.x), hn::Add(facing.y, on_sphere.y),
                 hn::Add(facing.z, on_sphere.z)};
  const Mask mirrors = has(surface, kMirrors), refracts = has(surface, kRefracts);
  Mask absorbed = hn::MaskFromVec(hn::Zero(d));
  Mask reflected = refracts;
  V reflectance = one;
  if (hn::AllFalse(d, hn::Or(mirrors, refracts))) return {next, absorbed, reflected, reflectance};

  const Triple<V> mirrored = minus_scaled(direction, outward, hn::Add(cosine, cosine));
  if (!hn::AllFalse(d, mirrors)) {
    Triple<V> spread_out = scaled(mirrored, read_(columns_.first));
    if (!hn::AllFalse(d, has(surface, kIsFuzzy))) {
      const V radius = cube_root(sampler.first(kChoice));
      spread_out = plus_scaled(spread_out, on_sphere, hn::Mul(radius, read_(columns_.second)));
    }
    absorbed = hn::And(mirrors, hn::Not(hn::Gt(dot(spread_out, facing), hn::Zero(d))));
    next = choose(mirrors, spread_out, next);
  }
  if (!hn::AllFalse(d, refracts)) {
    const Boundary glass = boundary(direction, facing, cosine, surface);
    reflectance = glass.reflectance;
    reflected = hn::Lt(sampler.first(kChoice), reflectance);
    next = choose(refracts, choose(reflected, mirrored, glass.refracted), next);
  }
  return {next, absorbed, reflected, reflectance};
}

/// Directions are those of points in a ball of radius b around a · mirrored. A direction has the
/// density ∫ r² dr along its chord of the ball, divided by the volume.
template <typename T>
HWY_INLINE auto Bsdf<T>::metal_density(Triple<V> mirrored, Triple<V> next) const -> V {
  const D d;
  const V zero = hn::Zero(d), one = set(1);
  const V a = read_(columns_.first), b = read_(columns_.second);
  const Triple<V> apart = minus(next, mirrored);
  const V squared = dot(apart, apart);  // accurate for small angles, unlike 1 − cos²
  const V along = hn::Mul(a, hn::NegMulAdd(set(0.5), squared, one));
  const V sine_squared = hn::Mul(squared, hn::NegMulAdd(set(0.25), squared, one));
  const V half_squared = hn::NegMulAdd(hn::Mul(a, a), sine_squared, hn::Mul(b, b));
  const V half = hn::Sqrt(hn::Max(half_squared, zero));
  const V end = hn::Add(along, half);
  // The chord starts at the origin if the ball contains it.
  const V through = hn::Mul(hn::Add(half, half), hn::MulAdd(hn::Mul(set(3), along), along,
                                                           hn::Mul(half, half)));
  const V cubes = hn::IfThenElse(hn::Lt(a, one), hn::Mul(hn::Mul(end, end), end), through);
  const V density = hn::Div(cubes, hn::Mul(hn::Mul(set(4), b), hn::Mul(b, b)));
  return hn::IfThenElseZero(hn::And(hn::Gt(half_squared, zero), hn::Gt(end, zero)), density);
}

template <typename T>
HWY_INLINE auto Bsdf<T>::boundary(Triple<V> direction, Triple<V> facing, V cosine,
                                  Bits surface) const -> Boundary {
  const D d;
  const V one = set(1), zero = hn::Zero(d);
  const V eta = hn::IfThenElse(hn::Gt(cosine, zero), read_(columns_.first), read_(columns_.second));
  const V incident = hn::Min(hn::Abs(cosine), one);
  const V sine_squared = hn::NegMulAdd(incident, incident, one);
  const V beyond_squared = hn::NegMulAdd(hn::Mul(eta, eta), sine_squared, one);
  const V straight = read_(columns_.straight);
  const V m = hn::Sub(one, incident), m2 = hn::Mul(m, m);
  V share = hn::MulAdd(hn::Sub(one, straight), hn::Mul(hn::Mul(m2, m2), m), straight);
  if (HWY_UNLIKELY(columns_.has_exact_fresnel)) {
    const V exact = fresnel_exact_lanes(incident, hn::Sqrt(hn::Max(beyond_squared, zero)), eta);
    share = hn::IfThenElse(has(surface, kIsExact), exact, share);
  }
  share = hn::IfThenElse(hn::Lt(beyond_squared, zero), one, share);
  const Triple<V> bent = scaled(plus_scaled(direction, facing, incident), eta);
  const V depth = hn::Sqrt(hn::Abs(hn::Sub(one, dot(bent, bent))));
  return {minus_scaled(bent, facing, depth), share};
}

}  // namespace sdlc::render::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
