// The state of the paths. Compiled once per instruction set, so it has no include guard but
// Highway's.
// clang-format off
#if defined(SDLC_RENDER_KERNEL_PATHS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SDLC_RENDER_KERNEL_PATHS_INL_H
#undef SDLC_RENDER_KERNEL_PATHS_INL_H
#else
#define SDLC_RENDER_KERNEL_PATHS_INL_H
#endif
// clang-format on

#include <hwy/highway.h>

#include "render/lanes/vector_math-inl.h"
#include "render/shading/lane_sampler-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sdlc::render::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// One path per lane.
template <typename T>
struct Paths {
  using D = Lanes<T>;
  using V = hn::Vec<D>;
  using Bits = hn::Vec<hn::RebindToUnsigned<D>>;
  using Mask = hn::Mask<D>;

  Mask alive;  ///< lanes that have a path
  Mask fresh;  ///< lanes whose ray is a camera ray

  Triple<V> origin;
  Triple<V> next;       ///< direction of the next ray, of any length
  Triple<V> direction;  ///< the same, normalised
  V time;

  // The sphere that the ray leaves.
  Bits departed;     ///< index as in Hit
  Triple<V> normal;  ///< outward, at the origin of the ray
  V radius;

  Triple<V> throughput;
  Bits depth_left;     ///< rays until the path is truncated
  Bits stream, order;  ///< LaneSampler

  // With KernelFeatures::lights.
  Triple<V> radiance;  ///< from light connections so far
  Mask light_sampled;  ///< the ray leaves a surface where a light was sampled
  V metal_density;     ///< Bsdf::metal_density of the ray if that surface is metal, otherwise 0
  V plain_square;      ///< KernelFeatures::pilot: see PlainPaths::squares
  V plain_metal_square;  ///< and PlainPaths::squares_without_metal

  // With KernelFeatures::caustics: the path since the camera or the last diffuse surface, as long
  // as it meets one caster only.
  enum Chain : std::uint32_t { kNone, kAtCamera, kInside, kLeft };
  Bits chain;  ///< a Chain: whether it is still before, inside or behind the caster
  Mask is_from_camera;
  V in_pixel_x, in_pixel_y;  ///< the place of the camera ray, from the lower left corner
  Triple<V> start;           ///< the point on the diffuse surface
  Triple<V> start_normal;    ///< on the side of the path
  Triple<V> start_direction;
  Bits caster;             ///< leaf of the caster
  V chords;                ///< through the caster so far
  V passed;                ///< the product of reflectances and transmittances
  V plain_caustic_square;  ///< KernelFeatures::pilot: see PlainPaths::squares_without_caustics

  static HWY_INLINE Paths begin(Mask alive) {
    const V zero = hn::Zero(D());
    const Bits none = hn::Zero(hn::RebindToUnsigned<D>());
    const Triple<V> nowhere{zero, zero, zero};
    return {.alive = alive,
            .fresh = alive,
            .origin = nowhere,
            .next = {zero, zero, hn::Set(D(), T{1})},
            .direction = nowhere,
            .time = zero,
            .departed = none,
            .normal = nowhere,
            .radius = zero,
            .throughput = nowhere,
            .depth_left = none,
            .stream = none,
            .order = none,
            .radiance = nowhere,
            .light_sampled = hn::MaskFromVec(zero),
            .metal_density = zero,
            .plain_square = zero,
            .plain_metal_square = zero,
            .chain = none,
            .is_from_camera = hn::MaskFromVec(zero),
            .in_pixel_x = zero,
            .in_pixel_y = zero,
            .start = nowhere,
            .start_normal = nowhere,
            .start_direction = nowhere,
            .caster = none,
            .chords = zero,
            .passed = zero,
            .plain_caustic_square = zero};
  }

  /// The ray leaves a diffuse surface where a light was sampled.
  HWY_INLINE Mask left_diffuse() const {
    return hn::And(light_sampled, hn::Eq(metal_density, hn::Zero(D())));
  }

  HWY_INLINE void add_radiance(Mask mask, Triple<V> contribution) {
    const auto add = [&](V sum, V term)
                         HWY_ATTR { return hn::Add(sum, hn::IfThenElseZero(mask, term)); };
    radiance = {add(radiance.x, contribution.x), add(radiance.y, contribution.y),
                add(radiance.z, contribution.z)};
  }

  HWY_INLINE LaneSampler<D> sampler(SamplerKind kind, Bits mixer) const {
    return {kind, stream, mixer, order};
  }
};

/// The distance at which a ray hits the sphere that it leaves again, negative if it does not.
/// `cosine` is between the ray and the outward normal.
template <typename V>
HWY_INLINE V rehit_distance(V cosine, V radius) {
  const hn::DFromV<V> d;
  using T = hn::TFromV<V>;
  return hn::IfThenElse(hn::Lt(cosine, hn::Zero(d)),
                        hn::Mul(hn::Mul(hn::Set(d, T{-2}), cosine), radius),
                        hn::Neg(hn::Set(d, T{1})));
}

}  // namespace sdlc::render::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
