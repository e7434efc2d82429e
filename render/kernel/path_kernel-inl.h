// The wide path tracer. Compiled once per instruction set, so it has no include guard but
// Highway's.
// clang-format off
#if defined(SDLC_RENDER_KERNEL_PATH_KERNEL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SDLC_RENDER_KERNEL_PATH_KERNEL_INL_H
#undef SDLC_RENDER_KERNEL_PATH_KERNEL_INL_H
#else
#define SDLC_RENDER_KERNEL_PATH_KERNEL_INL_H
#endif
// clang-format on

#include <array>
#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include <hwy/highway.h>

#include "render/kernel/camera_rays-inl.h"
#include "render/kernel/caustics-inl.h"
#include "render/kernel/emitter_counts-inl.h"
#include "render/kernel/interaction-inl.h"
#include "render/kernel/lane_runs-inl.h"
#include "render/kernel/nearest-inl.h"
#include "render/kernel/path_kernel.hpp"
#include "render/kernel/paths-inl.h"
#include "render/lanes/vector_math-inl.h"
#include "render/shading/bsdf-inl.h"
#include "render/shading/lane_sampler-inl.h"
#include "render/shading/light_sampler-inl.h"
#include "render/shading/sampler.hpp"

HWY_BEFORE_NAMESPACE();
namespace sdlc::render::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// The work of a thread: one path per lane, replaced as soon as it ends. The stages of trace() are
/// inline, so that the state of the paths stays in registers. Local structs of vectors are not
/// const: GCC 12 would keep them in memory.
template <typename T, typename F>
class WidePaths {
 public:
  HWY_INLINE WidePaths(const WideScene<T>& scene, const WideView<T>& view, std::span<PixelRun> runs,
                       TraceCounts& counts)
      : scene_(scene),
        view_(view),
        runs_(view, runs),
        emitters_(scene, view.emitters),
        is_observed_(emitters_.is_counting() || view.keeps_first_hits),
        counts_(counts),
        interactions_(scene),
        caustics_(scene, view, interactions_, tests_, counts) {}

  void trace(const std::atomic<bool>& cancel);

 private:
  using D = Lanes<T>;
  using DU = hn::RebindToUnsigned<D>;
  using V = hn::Vec<D>;
  using Bits = hn::Vec<DU>;
  using Mask = hn::Mask<D>;
  using Paths = render::HWY_NAMESPACE::Paths<T>;
  using Hit = render::HWY_NAMESPACE::Hit<T>;
  using Interaction = render::HWY_NAMESPACE::Interaction<T>;
  using Search = NearestSphere<T, F>;
  using Lights = LightSampler<T, F::kMotion>;
  using LightSample = typename Lights::Sample;
  static constexpr std::size_t kLanes = hn::MaxLanes(D());

  struct Ends {
    Mask emitted;  // on an emitter or in the sky
    Mask exhausted;
    Mask all;  // also absorbed paths
  };

  static HWY_INLINE V set(double v) { return hn::Set(D(), static_cast<T>(v)); }
  static HWY_INLINE Bits word(std::uint32_t v) { return hn::Set(DU(), v); }
  /// The mean over the channels.
  static HWY_INLINE V mean_square(Triple<V> color) { return hn::Div(dot(color, color), set(3)); }
  static HWY_INLINE double sum_of(Mask mask, V value) {
    return hn::GetLane(hn::SumOfLanes(D(), hn::IfThenElseZero(mask, value)));
  }

  static HWY_INLINE void set_directions(Paths& paths);
  HWY_INLINE Hit intersect(Paths& paths);
  /// `throughput`: of camera rays, so that it is the colour of the surface.
  HWY_NOINLINE void add_first_hits(Mask first, V distance, Bits index, Triple<V> direction,
                                   Triple<V> normal, Triple<V> throughput) const;
  HWY_INLINE Mask weigh_emission(Paths& paths, const Hit& hit, const Interaction& at) const;
  HWY_INLINE Ends end_paths(Paths& paths, const Interaction& at, Mask absorbed);
  HWY_INLINE void connect_lights(Paths& paths, const Interaction& at, const Ends& ends,
                                 const LaneSampler<D>& sampler);
  HWY_INLINE LightSample sample_light(Paths& paths, const Interaction& at, Mask connects,
                                      Triple<V> facing, const LaneSampler<D>& sampler) const;
  using CausticConnection = typename Caustics<T, F>::Connection;
  HWY_INLINE void add_connection(Paths& paths, const CausticConnection& found);
  HWY_INLINE Mask trace_shadow_rays(const Paths& paths, const LightSample& light);
  HWY_INLINE void count_connections(const LightSample& light, Mask visible,
                                    Triple<V> contribution, Mask is_diffuse) const;
  HWY_INLINE void accumulate(Paths& paths, const Ends& ends);
  HWY_INLINE Mask finite_only(Mask mask, Triple<V> contribution);

  const WideScene<T>& scene_;
  const WideView<T>& view_;
  LaneRuns<T, F::kPilot> runs_;
  EmitterCounts<T, F::kInstances> emitters_;
  const bool is_observed_;
  SphereTests tests_;
  TraceCounts& counts_;
  const Interactions<T, F> interactions_;
  Caustics<T, F> caustics_;
};

template <typename T, typename F>
void WidePaths<T, F>::trace(const std::atomic<bool>& cancel) {
  constexpr std::uint32_t kStepsBetweenLooks = 1024;
  constexpr std::uint32_t kVertexStep = kPairIncrement * kVertexPairs;
  const CameraRays<T, F> camera(scene_, view_);
  Paths paths = Paths::begin(runs_.active());
  for (std::uint32_t step = 1; !hn::AllFalse(D(), paths.alive); ++step) {
    if (step % kStepsBetweenLooks == 0 && cancel.load(std::memory_order_relaxed)) return;

    if (!hn::AllFalse(D(), paths.fresh)) {
      camera.start(paths, runs_);
      if constexpr (F::kCaustics) add_connection(paths, caustics_.connect_to_camera(paths, runs_));
    }
    set_directions(paths);
    Hit hit = intersect(paths);
    Interaction at = interactions_.at(paths, hit);
    paths.throughput = product(paths.throughput, at.color);
    Mask is_connected = hn::MaskFromVec(hn::Zero(D()));
    if constexpr (F::kLights) is_connected = weigh_emission(paths, hit, at);

    const LaneSampler<D> sampler = paths.sampler(view_.sampler, runs_.mixer());
    auto scattered = Bsdf<T>(scene_.bsdf, at.by_optics)
                         .sample(paths.direction, at.normal, at.cosine, at.surface, sampler);
    paths.next = scattered.direction;
    paths.stream = add_low_32(paths.stream, word(kVertexStep));
    if constexpr (F::kCaustics) caustics_.follow(paths, hit, at, scattered);
    interactions_.depart(paths, hit, at);
    Ends ends = end_paths(paths, at, scattered.absorbed);
    if constexpr (F::kCaustics) {
      paths.chain = hn::IfThenZeroElse(hn::RebindMask(DU(), ends.all), paths.chain);
    }
    if (HWY_UNLIKELY(is_observed_)) {  // one branch and plain values: others cost 4 % here
      if (emitters_.is_counting()) {
        const Mask emitted = hn::And(ends.emitted, at.is_hit);
        emitters_.add_vertices(hn::AndNot(is_connected, emitted), hit.index, ends.all, at.surface);
        if constexpr (F::kCaustics) {
          emitters_.add_contributions(hn::And(is_connected, emitted),
                                      hn::Sqrt(mean_square(paths.throughput)));
        }
      }
      if (view_.keeps_first_hits) {
        const Mask is_first =
            hn::RebindMask(D(), hn::Eq(paths.depth_left, word(view_.max_depth - 1)));
        add_first_hits(hn::And(hn::And(paths.alive, is_first), at.is_hit), hit.distance, hit.index,
                       paths.direction, at.normal, paths.throughput);
      }
    }
    if constexpr (F::kLights) connect_lights(paths, at, ends, sampler);
    accumulate(paths, ends);

    paths.fresh = ends.all;
    if (HWY_UNLIKELY(runs_.end_samples(ends.all))) {
      paths.alive = runs_.active();
      paths.fresh = hn::And(paths.fresh, paths.alive);
    }
  }
}

/// Normalises the directions of camera rays and scattered rays, here in one place.
template <typename T, typename F>
void WidePaths<T, F>::set_directions(Paths& paths) {
  const D d;
  const V zero = hn::Zero(d), one = set(1);
  V length_squared = dot(paths.next, paths.next);
  const Mask vanishes = hn::Lt(length_squared, set(1e-12));
  if (HWY_UNLIKELY(!hn::AllFalse(d, vanishes))) {
    // Near −n the sum of normal and unit vector has no digits left: use the normal.
    const Mask was_inside = hn::Gt(dot(paths.direction, paths.normal), zero);
    const V side = hn::IfThenElse(was_inside, hn::Neg(one), one);
    paths.next = choose(vanishes, scaled(paths.normal, side), paths.next);
    length_squared = hn::IfThenElse(vanishes, one, length_squared);
  }
  paths.direction = scaled(paths.next, hn::Div(one, hn::Sqrt(length_squared)));
}

template <typename T, typename F>
auto WidePaths<T, F>::intersect(Paths& paths) -> Hit {
  V cosine = dot(paths.direction, paths.normal);
  auto nearest = Search(scene_).find(paths.origin, paths.direction, paths.time, paths.departed,
                                     rehit_distance(cosine, paths.radius), paths.alive, tests_);
  if constexpr (kIsPortable) {
    if (HWY_UNLIKELY(scene_.camera_sphere == scene_.kSeveralCameraSpheres)) {
      CameraRays<T, F>(scene_, view_)
          .intersect_camera_spheres(paths.fresh, paths.direction, nearest, paths.departed,
                                    paths.normal, cosine);
    }
  }
  counts_.rays += hn::CountTrue(D(), paths.alive);
  return {nearest.t, nearest.index, cosine};
}

/// Adds normal, depth and albedo of the surfaces that camera rays hit to those of their pixels.
template <typename T, typename F>
void WidePaths<T, F>::add_first_hits(Mask first, V distance, Bits index, Triple<V> direction,
                                     Triple<V> normal, Triple<V> throughput) const {
  const D d;
  const V depth = hn::Mul(distance, dot(direction, spread(d, view_.forward)));
  const Mask is_inside = hn::Gt(dot(direction, normal), hn::Zero(d));
  normal = scaled(normal, hn::IfThenElse(is_inside, set(-1), set(1)));
  const std::array<V, 8> values{normal.x,     normal.y,     normal.z, throughput.x,
                                throughput.y, throughput.z, depth,    distance};
  alignas(64) std::array<std::array<T, kLanes>, 8> of_lanes;
  for (std::size_t i = 0; i < values.size(); ++i) hn::Store(values[i], d, of_lanes[i].data());
  alignas(64) std::array<hn::TFromD<DU>, kLanes> indices;
  hn::Store(index, DU(), indices.data());
  for (std::uint32_t lanes = bits_of(d, first); lanes != 0; lanes &= lanes - 1) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(lanes));
    const auto value = [&](std::size_t i) { return static_cast<double>(of_lanes[i][lane]); };
    runs_.run(lane).first_hits->add({.normal = {value(0), value(1), value(2)},
                                     .depth = value(6) * view_.depth_units,
                                     .albedo = {value(3), value(4), value(5)}});
    if (view_.picked == nullptr) continue;
    const auto slot_and_row = static_cast<std::uint64_t>(indices[lane]);
    *view_.picked = {.slot = static_cast<std::uint32_t>(slot_and_row),
                     .row = static_cast<std::uint32_t>(slot_and_row >> 32),
                     .distance = value(7)};
  }
}

/// Multiple importance sampling: emission is weighted where its light was also sampled at the
/// surface that the ray leaves. Returns the paths that Caustics finds, too.
template <typename T, typename F>
auto WidePaths<T, F>::weigh_emission(Paths& paths, const Hit& hit, const Interaction& at) const
    -> Mask {
  const D d;
  if constexpr (F::kPilot) {
    paths.plain_square = mean_square(paths.throughput);
    paths.plain_metal_square = hn::Zero(d);
  }
  const Bits leaf = at.by_slot(scene_.lights.leaf_of_slot);
  const Mask has_leaf = hn::RebindMask(d, hn::Ne(leaf, word(kNoLight)));
  Mask is_connected = hn::MaskFromVec(hn::Zero(d));
  if constexpr (F::kCaustics) {
    const V weight = caustics_.weight(paths, at, leaf);
    paths.throughput = scaled(paths.throughput, weight);
    is_connected = hn::Lt(weight, set(1));
    if constexpr (F::kPilot) {
      paths.plain_square = hn::Mul(paths.plain_square, weight);
      paths.plain_caustic_square = hn::Mul(paths.plain_square, hn::Sub(set(1), weight));
    }
  }
  const Mask is_light = hn::And(hn::And(at.is_hit, paths.light_sampled), has_leaf);
  if (hn::AllFalse(d, is_light)) return is_connected;
  const Triple<V> normal = flipped(paths.normal, hn::And(hit.cosine, hn::SignBit(d)));
  const V scattering =
      hn::IfThenElse(paths.left_diffuse(), hn::Abs(hit.cosine), paths.metal_density);
  const V weight = hn::IfThenElse(
      is_light,
      Lights(scene_.lights)
          .bsdf_weight(is_light, leaf, {paths.origin, normal, paths.time}, scattering),
      set(1));
  paths.throughput = scaled(paths.throughput, weight);
  if constexpr (F::kPilot) {
    paths.plain_square = hn::Mul(paths.plain_square, weight);
    const Mask left_metal = hn::AndNot(paths.left_diffuse(), is_light);
    paths.plain_metal_square = hn::IfThenElseZero(
        left_metal, hn::Mul(paths.plain_square, hn::Sub(set(1), weight)));
  }
  return is_connected;
}

template <typename T, typename F>
auto WidePaths<T, F>::end_paths(Paths& paths, const Interaction& at, Mask absorbed) -> Ends {
  const D d;
  paths.depth_left = hn::Sub(paths.depth_left, word(1));
  const Mask is_last = hn::RebindMask(d, hn::Eq(paths.depth_left, hn::Zero(DU())));
  const Mask is_emitter = hn::Or(hn::Not(at.is_hit), Bsdf<T>::has(at.surface, kEndsPath));
  const Mask emitted = hn::And(paths.alive, is_emitter);
  const Mask exhausted = hn::And(paths.alive, is_last);
  const Mask ended = hn::Or(emitted, hn::And(paths.alive, absorbed));
  counts_.truncated_paths += hn::CountTrue(d, hn::AndNot(ended, exhausted));
  return {.emitted = emitted, .exhausted = exhausted, .all = hn::Or(ended, exhausted)};
}

/// Next event estimation: adds the radiance of one sampled light at each surface that is diffuse
/// or rough metal, where the scattered ray may have been absorbed.
template <typename T, typename F>
void WidePaths<T, F>::connect_lights(Paths& paths, const Interaction& at, const Ends& ends,
                                     const LaneSampler<D>& sampler) {
  const D d;
  const Mask is_diffuse = hn::And(at.is_hit, Bsdf<T>::is_diffuse(at.surface));
  const Mask is_sampled = hn::Or(is_diffuse, Bsdf<T>::has(at.surface, kIsRough));
  const Mask connects = hn::And(hn::AndNot(ends.exhausted, paths.alive), is_sampled);
  paths.light_sampled = hn::AndNot(ends.all, connects);
  if constexpr (F::kPilot) {
    view_.plain->choices += hn::CountTrue(d, connects);
    view_.plain->metal_choices += hn::CountTrue(d, hn::AndNot(is_diffuse, connects));
  }
  if (hn::AllFalse(d, connects)) return;
  const Triple<V> facing = flipped(at.normal, hn::AndNot(at.cosine, hn::SignBit(d)));
  if constexpr (F::kCaustics) {
    const Mask starts = hn::And(connects, is_diffuse);
    add_connection(paths, caustics_.connect(starts, paths, facing, sampler));
  }
  LightSample light = sample_light(paths, at, connects, facing, sampler);
  if (hn::AllFalse(d, light.exists)) return;

  const Mask visible = trace_shadow_rays(paths, light);
  if (HWY_UNLIKELY(emitters_.is_counting())) emitters_.add_connections(visible, light.slot);
  const Triple<V> contribution = product(paths.throughput, light.radiance);
  paths.add_radiance(visible, contribution);
  if constexpr (F::kPilot) count_connections(light, visible, contribution, is_diffuse);
}

/// Sets Paths::metal_density, too.
template <typename T, typename F>
auto WidePaths<T, F>::sample_light(Paths& paths, const Interaction& at, Mask connects,
                                   Triple<V> facing, const LaneSampler<D>& sampler) const
    -> LightSample {
  const D d;
  const typename Lights::Place place{paths.origin, facing, paths.time};
  paths.metal_density = hn::Zero(d);
  const Mask is_metal = hn::And(connects, Bsdf<T>::has(at.surface, kIsRough));
  if (hn::AllFalse(d, is_metal)) {
    return Lights(scene_.lights)
        .sample(connects, place, sampler, [](Triple<V>, V cosine) HWY_ATTR { return cosine; });
  }
  const Bsdf<T> bsdf(scene_.bsdf, at.by_optics);
  const Triple<V> mirrored =
      minus_scaled(paths.direction, at.normal, hn::Add(at.cosine, at.cosine));
  const auto scattering = [&](Triple<V> direction, V cosine) HWY_ATTR {
    return hn::IfThenElse(is_metal, bsdf.metal_density(mirrored, direction), cosine);
  };
  const V length = hn::Sqrt(dot(paths.next, paths.next));
  const Triple<V> next = scaled(paths.next, hn::Div(set(1), length));
  // At the edge of the ball it may be 0, which stands for diffuse surfaces.
  const V density = hn::Max(bsdf.metal_density(mirrored, next), set(1e-30));
  paths.metal_density = hn::IfThenElseZero(is_metal, density);
  return Lights(scene_.lights).sample(connects, place, sampler, scattering);
}

template <typename T, typename F>
void WidePaths<T, F>::add_connection(Paths& paths, const CausticConnection& found) {
  const D d;
  if (hn::AllFalse(d, found.exists)) return;
  const Triple<V> contribution = product(paths.throughput, found.radiance);
  paths.add_radiance(found.exists, contribution);
  if (HWY_UNLIKELY(emitters_.is_counting())) {
    emitters_.add_connections(found.exists, found.slot);
    emitters_.add_contributions(found.exists, hn::Sqrt(mean_square(contribution)));
  }
  if constexpr (F::kPilot) {
    PlainPaths& plain = *view_.plain;
    plain.caustics += hn::CountTrue(d, found.exists);
    const V square = hn::Div(mean_square(contribution), found.weight);
    plain.squares += sum_of(found.exists, square);
    plain.squares_without_caustics +=
        sum_of(found.exists, hn::Mul(square, hn::Sub(set(1), found.weight)));
  }
}

/// The lanes whose light is not occluded.
template <typename T, typename F>
auto WidePaths<T, F>::trace_shadow_rays(const Paths& paths, const LightSample& light) -> Mask {
  const D d;
  const V rehit = rehit_distance(dot(light.direction, paths.normal), paths.radius);
  const auto nearest = Search(scene_).find(paths.origin, light.direction, paths.time,
                                           paths.departed, rehit, light.exists, tests_);
  counts_.rays += hn::CountTrue(d, light.exists);
  // If the ray hits or just misses the light's own surface, rounding decides; both count as
  // visible.
  const Mask occluded = hn::And(hn::Lt(nearest.t, light.distance),
                                hn::RebindMask(d, hn::Ne(nearest.index, light.slot)));
  return hn::AndNot(occluded, light.exists);
}

template <typename T, typename F>
void WidePaths<T, F>::count_connections(const LightSample& light, Mask visible,
                                        Triple<V> contribution, Mask is_diffuse) const {
  const D d;
  PlainPaths& plain = *view_.plain;
  plain.shadow_rays += hn::CountTrue(d, light.exists);
  plain.connections += hn::CountTrue(d, visible);
  const Mask weighs = hn::And(visible, hn::Gt(light.bsdf_weight, hn::Zero(d)));
  const V square = hn::Div(mean_square(contribution), light.bsdf_weight);
  plain.squares += sum_of(weighs, square);
  plain.metal_shadow_rays += hn::CountTrue(d, hn::AndNot(is_diffuse, light.exists));
  plain.metal_connections += hn::CountTrue(d, hn::AndNot(is_diffuse, visible));
  plain.squares_without_metal += sum_of(hn::AndNot(is_diffuse, weighs),
                                        hn::Mul(square, hn::Sub(set(1), light.bsdf_weight)));
}

/// Adds the contributions of the paths that ended.
template <typename T, typename F>
void WidePaths<T, F>::accumulate(Paths& paths, const Ends& ends) {
  Mask contributes = ends.emitted;
  Triple<V> contribution = paths.throughput;
  if constexpr (F::kLights) {
    const auto add = [&](V emitted, V radiance) HWY_ATTR {
      return hn::Add(hn::IfThenElseZero(ends.emitted, emitted), radiance);
    };
    contributes = ends.all;
    contribution = {add(contribution.x, paths.radiance.x), add(contribution.y, paths.radiance.y),
                    add(contribution.z, paths.radiance.z)};
    const V zero = hn::Zero(D());
    paths.radiance = choose(ends.all, Triple<V>{zero, zero, zero}, paths.radiance);
  }
  if constexpr (F::kPilot) {
    contributes = hn::AndNot(paths.fresh, contributes);
    const Mask emitted = hn::AndNot(paths.fresh, ends.emitted);
    view_.plain->squares += sum_of(emitted, paths.plain_square);
    view_.plain->squares_without_metal += sum_of(emitted, paths.plain_metal_square);
    if constexpr (F::kCaustics) {
      view_.plain->squares_without_caustics += sum_of(emitted, paths.plain_caustic_square);
    }
  }
  runs_.add(finite_only(contributes, contribution), contribution);
}

/// The lanes of `mask` with finite contributions; counts the others.
template <typename T, typename F>
auto WidePaths<T, F>::finite_only(Mask mask, Triple<V> contribution) -> Mask {
  const D d;
  const V infinity = hn::Set(d, std::numeric_limits<T>::infinity());
  const V total = hn::Add(hn::Add(contribution.x, contribution.y), contribution.z);
  const Mask is_finite = hn::Lt(hn::Abs(total), infinity);
  if (HWY_LIKELY(hn::AllFalse(d, hn::AndNot(is_finite, mask)))) return mask;
  counts_.nonfinite_samples += hn::CountTrue(d, hn::AndNot(is_finite, mask));
  return hn::And(mask, is_finite);
}

template <typename T, typename F>
void trace_runs(const WideScene<T>& scene, const WideView<T>& view, std::span<PixelRun> runs,
                TraceCounts& counts, const std::atomic<bool>& cancel) noexcept {
  WidePaths<T, F>(scene, view, runs, counts).trace(cancel);
}

/// What has source files of its own, and is therefore a template parameter.
enum class Extra : std::uint8_t { None, Lights, Lens, LensAndLights, Caustics };

/// KernelFeatures::caustics includes the lens.
template <Extra kExtra, bool motion, bool exact_spheres, bool bvh, bool instances>
using FeaturesWith = Features<motion, exact_spheres, bvh, instances,
                              kExtra == Extra::Lights || kExtra >= Extra::LensAndLights, false,
                              kExtra >= Extra::Lens, kExtra == Extra::Caustics>;

template <typename T, Extra kExtra, bool kMotion, bool kExactSpheres, bool kInstances = false>
TraceRuns<T>* choose_search(KernelFeatures features) noexcept {
  if constexpr (!kInstances) {
    if (!features.bvh) {
      return &trace_runs<T, FeaturesWith<kExtra, kMotion, kExactSpheres, false, false>>;
    }
  }
  return &trace_runs<T, FeaturesWith<kExtra, kMotion, kExactSpheres, true, kInstances>>;
}

/// `kExtra` as in `features`.
template <typename T, Extra kExtra>
TraceRuns<T>* choose_kernel(KernelFeatures features) noexcept {
  if constexpr (sizeof(T) == 8) {
    if (features.instances) {
      return features.motion ? choose_search<T, kExtra, true, false, true>(features)
                             : choose_search<T, kExtra, false, false, true>(features);
    }
  }
  if constexpr (sizeof(T) == 4) {
    if (features.exact_spheres) {
      return features.motion ? choose_search<T, kExtra, true, true>(features)
                             : choose_search<T, kExtra, false, true>(features);
    }
  }
  return features.motion ? choose_search<T, kExtra, true, false>(features)
                         : choose_search<T, kExtra, false, false>(features);
}

}  // namespace sdlc::render::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
