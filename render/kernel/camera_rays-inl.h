// The first rays of paths. Compiled once per instruction set, so it has no include guard but
// Highway's.
// clang-format off
#if defined(SDLC_RENDER_KERNEL_CAMERA_RAYS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SDLC_RENDER_KERNEL_CAMERA_RAYS_INL_H
#undef SDLC_RENDER_KERNEL_CAMERA_RAYS_INL_H
#else
#define SDLC_RENDER_KERNEL_CAMERA_RAYS_INL_H
#endif
// clang-format on

#include <cstdint>

#include <hwy/highway.h>

#include "render/kernel/nearest-inl.h"
#include "render/kernel/path_kernel.hpp"
#include "render/kernel/paths-inl.h"
#include "render/kernel/wide_scene.hpp"
#include "render/lanes/vector_math-inl.h"
#include "render/shading/lane_sampler-inl.h"
#include "render/shading/sampler.hpp"

HWY_BEFORE_NAMESPACE();
namespace sdlc::render::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

template <typename T, typename F>
class CameraRays {
 public:
  using D = Lanes<T>;
  using DU = hn::RebindToUnsigned<D>;
  using V = hn::Vec<D>;
  using Bits = hn::Vec<DU>;
  using Mask = hn::Mask<D>;
  using Nearest = typename NearestSphere<T, F>::Nearest;

  HWY_INLINE CameraRays(const WideScene<T>& scene, const WideView<T>& view)
      : scene_(scene), view_(view) {}

  template <typename Runs>
  HWY_INLINE void start(Paths<T>& paths, Runs& runs) const;
  void intersect_camera_spheres(Mask fresh, Triple<V> direction, Nearest& nearest, Bits& departed,
                                Triple<V>& normal, V& cosine) const;

 private:
  static HWY_INLINE Bits word(std::uint32_t v) { return hn::Set(DU(), v); }

  HWY_INLINE Bits stream_start(Bits stream_key, Bits mixer, Bits sample) const;
  HWY_INLINE void start_at_lens(Paths<T>& paths, Triple<V> place,
                                typename LaneSampler<D>::Pair random) const;
  HWY_INLINE void depart_from_camera(Paths<T>& paths) const;

  const WideScene<T>& scene_;
  const WideView<T>& view_;
};

/// Starts a path in the fresh lanes.
template <typename T, typename F>
template <typename Runs>
void CameraRays<T, F>::start(Paths<T>& paths, Runs& runs) const {
  const D d;
  const auto fresh_bits = hn::RebindMask(DU(), paths.fresh);
  const V zero = hn::Zero(d), one = hn::Set(d, T{1});

  const Bits sample = runs.take_samples(paths.fresh);
  const Bits start = stream_start(runs.stream_key(), runs.mixer(), sample);
  paths.order = hn::IfThenElse(fresh_bits, reverse_lane_bits(sample), paths.order);
  const LaneSampler<D> sampler(view_.sampler, start, runs.mixer(), paths.order);
  const auto in_pixel = sampler.pair(kPixel);
  const Triple<V> place =
      plus_scaled(plus_scaled(runs.corner(), spread(d, view_.spread_right), in_pixel.first),
                  spread(d, view_.spread_up), in_pixel.second);
  if constexpr (F::kCaustics) {
    paths.in_pixel_x = hn::IfThenElse(paths.fresh, in_pixel.first, paths.in_pixel_x);
    paths.in_pixel_y = hn::IfThenElse(paths.fresh, in_pixel.second, paths.in_pixel_y);
  }
  if constexpr (F::kMotion) {
    paths.time = hn::IfThenElse(paths.fresh, sampler.first(kTime), paths.time);
  }
  const Bits at_vertex = add_low_32(start, word(kPairIncrement * kCameraPairs));
  paths.stream = hn::IfThenElse(fresh_bits, at_vertex, paths.stream);
  if constexpr (F::kLens) {
    start_at_lens(paths, place, sampler.pair(kLens));
  } else {
    paths.next = choose(paths.fresh, place, paths.next);
    paths.origin = choose(paths.fresh, Triple<V>{zero, zero, zero}, paths.origin);
  }
  paths.throughput = choose(paths.fresh, Triple<V>{one, one, one}, paths.throughput);
  paths.depth_left = hn::IfThenElse(fresh_bits, word(view_.max_depth), paths.depth_left);
  depart_from_camera(paths);
}

/// What the words of a sample are computed from. For Sobol' points they select the scrambling,
/// which is the same for all samples.
template <typename T, typename F>
auto CameraRays<T, F>::stream_start(Bits stream_key, Bits mixer, Bits sample) const -> Bits {
  Bits start = stream_key;
  if (view_.sampler == SamplerKind::Independent) {
    start = add_low_32(start, mul_low_32(sample, kWordIncrement));
  }
  start = mix_lanes(start, mixer);
  return hn::Xor(start, hn::ShiftRight<16>(start));
}

/// A thin lens: rays start on it, and those of one point of the image plane meet in the plane in
/// focus. At a distance f along the axis, the ray through the centre is at f · `place`; so a ray
/// from the point p has the direction f · place − p, or place − p / f. A uniform point of the disc
/// has weight 1. The concentric map of the square (Shirley, Chiu, "A low distortion map between
/// disk and square", 1997) is continuous and keeps areas, so Sobol' points stay well distributed.
template <typename T, typename F>
void CameraRays<T, F>::start_at_lens(Paths<T>& paths, Triple<V> place,
                                     typename LaneSampler<D>::Pair random) const {
  const D d;
  const V zero = hn::Zero(d), one = hn::Set(d, T{1});
  const V a = hn::Sub(hn::Add(random.first, random.first), one);
  const V b = hn::Sub(hn::Add(random.second, random.second), one);
  const Mask is_wide = hn::Gt(hn::Abs(a), hn::Abs(b));
  const V radius = hn::IfThenElse(is_wide, a, b), other = hn::IfThenElse(is_wide, b, a);
  const V divisor = hn::IfThenElse(hn::Eq(radius, zero), one, radius);  // the centre: 0 / 0
  const V turn = hn::Mul(hn::Div(other, divisor), hn::Set(d, T{0.125}));
  const V cosine = sine_of_quarter_turn(hn::Sub(hn::Set(d, T{0.25}), hn::Abs(turn)));
  const V along = hn::Mul(radius, cosine), across = hn::Mul(radius, sine_of_quarter_turn(turn));
  const V x = hn::IfThenElse(is_wide, along, across), y = hn::IfThenElse(is_wide, across, along);

  const Triple<V> in_view = plus_scaled(scaled(spread(d, view_.lens_right_in_view), x),
                                        spread(d, view_.lens_up_in_view), y);
  const Triple<V> next = minus_scaled(place, in_view, one);
  const Triple<V> origin =
      plus_scaled(scaled(spread(d, view_.lens_right), x), spread(d, view_.lens_up), y);
  paths.next = choose(paths.fresh, next, paths.next);
  paths.origin = choose(paths.fresh, origin, paths.origin);
}

/// The camera may be in the surface of a sphere.
template <typename T, typename F>
void CameraRays<T, F>::depart_from_camera(Paths<T>& paths) const {
  const D d;
  Bits sphere = word(scene_.camera_sphere);
  if constexpr (F::kInstances) {
    sphere = hn::Or(sphere, hn::ShiftLeft<32>(word(scene_.instances.camera_row)));
  }
  paths.departed = hn::IfThenElse(hn::RebindMask(DU(), paths.fresh), sphere, paths.departed);
  if (HWY_UNLIKELY(scene_.camera_sphere != scene_.kNoCameraSphere)) {
    const V radius = hn::Set(d, scene_.camera_sphere_radius);
    paths.normal = choose(paths.fresh, spread(d, scene_.camera_normal), paths.normal);
    paths.radius = hn::IfThenElse(paths.fresh, radius, paths.radius);
  }
}

/// The first hits of camera rays that leave several spheres. `nearest` is that of all other
/// spheres; these can only be hit from inside, where rays leave them again. Out of line, and with
/// arguments in memory: the case is rare.
template <typename T, typename F>
void CameraRays<T, F>::intersect_camera_spheres(Mask fresh, Triple<V> direction, Nearest& nearest,
                                                Bits& departed, Triple<V>& normal,
                                                V& cosine) const {
  const D d;
  const DU du;
  for (const auto& sphere : scene_.camera_spheres) {
    const Triple<V> outward = spread(d, sphere.normal);
    const V cosine_here = dot(direction, outward);
    const V rehit = rehit_distance(cosine_here, hn::Set(d, sphere.radius));
    const Mask is_nearer =
        hn::And(fresh, hn::And(hn::Ge(rehit, hn::Zero(d)), hn::Lt(rehit, nearest.t)));
    const auto is_nearer_bits = hn::RebindMask(du, is_nearer);
    nearest.t = hn::IfThenElse(is_nearer, rehit, nearest.t);
    nearest.index = hn::IfThenElse(is_nearer_bits, word(sphere.slot), nearest.index);
    departed = hn::IfThenElse(is_nearer_bits, word(sphere.slot), departed);
    normal = choose(is_nearer, outward, normal);
    cosine = hn::IfThenElse(is_nearer, cosine_here, cosine);
  }
}

}  // namespace sdlc::render::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
