// Connections from diffuse surfaces to lights by way of mirrors and glass. Compiled once per
// instruction set, so it has no include guard but Highway's.
// clang-format off
#if defined(SDLC_RENDER_KERNEL_CAUSTICS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SDLC_RENDER_KERNEL_CAUSTICS_INL_H
#undef SDLC_RENDER_KERNEL_CAUSTICS_INL_H
#else
#define SDLC_RENDER_KERNEL_CAUSTICS_INL_H
#endif
// clang-format on

#include <cstddef>
#include <cstdint>

#include <hwy/highway.h>

#include "render/film/trace_counts.hpp"
#include "render/kernel/interaction-inl.h"
#include "render/kernel/nearest-inl.h"
#include "render/kernel/paths-inl.h"
#include "render/kernel/wide_scene.hpp"
#include "render/lanes/table_reader-inl.h"
#include "render/lanes/vector_math-inl.h"
#include "render/shading/bsdf-inl.h"
#include "render/shading/lane_sampler-inl.h"
#include "render/shading/light_sampler-inl.h"
#include "render/shading/sampler.hpp"
#include "render/shading/sphere_sweep-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sdlc::render::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Manifold next event estimation (Hanika, Droske, Fascione, "Manifold next event estimation",
/// 2015) for spheres: at a diffuse surface, chooses a caster, which is a smooth mirror or a ball of
/// glass, a point on a light, and one of the paths that lead there by the caster alone, all of which
/// SphereSweep knows. The balance heuristic weighs that against scattered rays that take the same
/// path: both techniques have the weight p_b / (p_b + p_m), with p_b = cos/π times the reflectances
/// and transmittances along the path, and p_m the density of the connection, both per solid angle
/// at the diffuse surface.
template <typename T, typename F>
class Caustics {
 public:
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
  using Place = typename Lights::Place;
  using BsdfSample = typename Bsdf<T>::Sample;

  HWY_INLINE Caustics(const WideScene<T>& scene, const Interactions<T, F>& interactions,
                      SphereTests& tests, TraceCounts& counts)
      : scene_(scene), interactions_(interactions), tests_(tests), counts_(counts) {}

  /// The weight of the emission that the paths find; 1 for those that no connection could find.
  /// `leaf`: of the light that was hit, or kNoLight.
  HWY_NOINLINE V weight(const Paths& paths, const Hit& hit, const Interaction& at,
                        Bits leaf) const;
  /// Records what the paths have met since the last diffuse surface. Before the paths depart.
  HWY_INLINE void follow(Paths& paths, const Hit& hit, const Interaction& at,
                         const BsdfSample& scattered) const;

  struct Connection {
    Mask exists;         ///< the other members are undefined elsewhere
    Triple<V> radiance;  ///< contribution without the attenuation of the diffuse surface
    Bits slot;           ///< of the light
  };
  /// For the lanes of `wanted`, which leave a diffuse surface. `facing`: the normal on the side of
  /// the path.
  HWY_NOINLINE Connection connect(Mask wanted, const Paths& paths, Triple<V> facing,
                                  const LaneSampler<D>& sampler) const;

 private:
  static constexpr std::uint32_t kMaxChords = 6;

  struct Caster {
    Triple<V> center, color;
    V radius, index;  // index 0: a mirror
    Bits slot, leaf;
  };
  struct Light {
    Triple<V> center, radiance;
    V radius;
    V probability;
    Bits slot;
  };
  /// A light as seen from a caster.
  struct Cap {
    Triple<V> axis;  // from the light to the caster
    V height;        // of the part of the light, in its radii, that some of the caster sees
    Mask exists;
  };
  /// x and y as SphereSweep sees them.
  struct Ends {
    V a, b, angle, sine;
    Triple<V> towards;  // from x to the centre, length 1
    Triple<V> across;   // perpendicular to that, towards y, length 1
  };

  static HWY_INLINE V set(double v) { return hn::Set(D(), static_cast<T>(v)); }
  static HWY_INLINE Bits word(std::uint32_t v) { return hn::Set(DU(), v); }
  static HWY_INLINE Mask is(Bits a, Bits b) { return hn::RebindMask(D(), hn::Eq(a, b)); }
  static HWY_INLINE V length(Triple<V> v) { return hn::Sqrt(dot(v, v)); }

  /// Precondition: below 2^24.
  static HWY_INLINE V number(Bits v) {
    if constexpr (sizeof(T) == 4) {
      return hn::ConvertTo(D(), hn::BitCast(hn::RebindToSigned<D>(), v));
    } else {
      const V magic = set(0x1p52);  // its low bits hold whole numbers
      return hn::Sub(hn::BitCast(D(), hn::Or(v, hn::BitCast(DU(), magic))), magic);
    }
  }
  HWY_INLINE Caster caster(Bits leaf, V time) const;
  HWY_INLINE Light light(Bits leaf, V time) const;
  HWY_INLINE Bits choose_light(V u) const;
  static HWY_INLINE V choose_chords(V u, V index);
  static HWY_INLINE V chance_of_chords(V chords, V index);
  static HWY_INLINE Cap cap(const Caster& by, const Light& light);
  static HWY_INLINE Ends ends(Triple<V> x, Triple<V> y, const Caster& by);
  /// The density of a connection divided by that of scattering.
  static HWY_INLINE V odds(V chosen, V paths, V density, V facing_light, V scattered,
                           const Caster& by, const Light& light, const Cap& cap);

  const WideScene<T>& scene_;
  const Interactions<T, F>& interactions_;
  SphereTests& tests_;
  TraceCounts& counts_;
};

template <typename T, typename F>
auto Caustics<T, F>::caster(Bits leaf, V time) const -> Caster {
  const TableReader<D> read(leaf, scene_.casters.leaves);
  Triple<V> center = read(scene_.casters.center);
  if constexpr (F::kMotion) center = plus_scaled(center, read(scene_.casters.shift), time);
  const Bits slot = read(scene_.casters.slot);
  const TableReader<D> by_optics = interactions_.optics_of(slot);
  const Mask is_glass = Bsdf<T>::has(by_optics(scene_.bsdf.surface), kRefracts);
  return {.center = center,
          .color = read(scene_.casters.radiance),
          .radius = read(scene_.casters.radius),
          .index = hn::IfThenElseZero(is_glass, by_optics(scene_.bsdf.first)),
          .slot = slot,
          .leaf = leaf};
}

template <typename T, typename F>
auto Caustics<T, F>::light(Bits leaf, V time) const -> Light {
  const WideLights<T>& lights = scene_.lights;
  const TableReader<D> read(leaf, lights.leaves);
  Triple<V> center = read(lights.center);
  if constexpr (F::kMotion) center = plus_scaled(center, read(lights.shift), time);
  const TableReader<D> by_node(hn::Add(leaf, word(lights.leaves)), lights.nodes);
  return {.center = center,
          .radiance = read(lights.radiance),
          .radius = read(lights.radius),
          .probability = hn::Div(by_node(lights.node_power), hn::Set(D(), lights.node_power[1])),
          .slot = read(lights.slot)};
}

/// By power alone, because the light may come to the caster from any side.
template <typename T, typename F>
auto Caustics<T, F>::choose_light(V u) const -> Bits {
  const WideLights<T>& lights = scene_.lights;
  Bits node = word(1);
  for (int level = 0; level < lights.levels; ++level) {
    const Bits left = hn::Add(node, node);
    const V of_left = TableReader<D>(left, lights.nodes)(lights.node_power);
    const V of_both = TableReader<D>(node, lights.nodes)(lights.node_power);
    const V share = hn::Div(of_left, of_both);
    const Mask goes_left = hn::Lt(u, share);
    const V rest = hn::Sub(set(1), share);
    u = hn::Div(hn::IfThenElse(goes_left, u, hn::Sub(u, share)),
                hn::IfThenElse(goes_left, share, rest));
    node = hn::Add(left, hn::IfThenZeroElse(hn::RebindMask(DU(), goes_left), word(1)));
  }
  return hn::Sub(node, word(lights.leaves));
}

/// The number of chords in glass: 1 for half of the connections, 0 for a quarter, and N > 1 for
/// 2^-(N + 1), which falls as the light does.
template <typename T, typename F>
auto Caustics<T, F>::choose_chords(V u, V index) -> V {
  const V one = set(1), zero = hn::Zero(D());
  V chords = hn::IfThenElse(hn::Lt(u, set(0.5)), one, hn::IfThenElseZero(hn::Ge(u, set(0.75)), one));
  double limit = 0.75;
  for (std::uint32_t n = 2; n <= kMaxChords + 1; ++n) {
    chords = hn::IfThenElse(hn::Ge(u, set(limit)), set(n), chords);
    limit = (1 + limit) / 2;
  }
  return hn::IfThenElseZero(hn::Gt(index, zero), chords);
}

template <typename T, typename F>
auto Caustics<T, F>::chance_of_chords(V chords, V index) -> V {
  V chance = hn::IfThenElse(hn::Lt(chords, set(0.5)), set(0.25), set(0.5));
  double of = 0.25;
  for (std::uint32_t n = 2; n <= kMaxChords + 1; ++n) {
    of = n > kMaxChords ? 0 : of / 2;
    chance = hn::IfThenElse(hn::Gt(chords, set(n - 0.5)), set(of), chance);
  }
  return hn::IfThenElse(hn::Gt(index, hn::Zero(D())), chance, set(1));
}

/// Some point of the caster sees a point of the light with the normal n if the cosine between n and
/// the axis is above (R − r) / D, for the radii R of the light and r of the caster at distance D.
template <typename T, typename F>
auto Caustics<T, F>::cap(const Caster& by, const Light& light) -> Cap {
  const Triple<V> axis = minus(by.center, light.center);
  const V distance = length(axis);
  const V part = hn::Div(hn::Sub(by.radius, light.radius), distance);
  return {.axis = scaled(axis, hn::Div(set(1), distance)),
          .height = hn::Add(set(1), part),
          .exists = hn::Gt(distance, hn::Add(by.radius, light.radius))};
}

template <typename T, typename F>
auto Caustics<T, F>::ends(Triple<V> x, Triple<V> y, const Caster& by) -> Ends {
  const V one = set(1);
  const V scale = hn::Div(one, by.radius);
  const Triple<V> to_x = scaled(minus(x, by.center), scale);
  const Triple<V> to_y = scaled(minus(y, by.center), scale);
  const V a = length(to_x), b = length(to_y);
  const Triple<V> at_x = scaled(to_x, hn::Div(one, a)), at_y = scaled(to_y, hn::Div(one, b));
  const V cosine = dot(at_x, at_y);
  const Triple<V> across = minus_scaled(at_y, at_x, cosine);
  const V sine = length(across);
  const Triple<V> difference = minus(at_x, at_y), sum = plus_scaled(at_x, at_y, one);
  // Accurate near 0 and π, too (Kahan).
  const V quarter = set(kPi / 4);
  const V apart = length(difference), together = length(sum);
  const Mask is_near = hn::Lt(apart, together);
  const V ratio = hn::Div(hn::IfThenElse(is_near, apart, together),
                          hn::IfThenElse(is_near, together, apart));
  const V half = hn::Atan(D(), ratio);
  const V angle = hn::IfThenElse(is_near, half, hn::Sub(hn::Add(quarter, quarter), half));
  return {.a = hn::Max(a, one),
          .b = b,
          .angle = hn::Add(angle, angle),
          .sine = sine,
          .towards = scaled(at_x, set(-1)),
          .across = scaled(across, hn::Div(one, sine))};
}

template <typename T, typename F>
auto Caustics<T, F>::odds(V chosen, V paths, V density, V facing_light, V scattered,
                          const Caster& by, const Light& light, const Cap& cap) -> V {
  const V size = hn::Div(by.radius, light.radius);
  const V per_area = hn::Div(hn::Mul(size, size), hn::Mul(set(kTurn), cap.height));
  const V connected = hn::Div(hn::Mul(chosen, per_area),
                              hn::Mul(hn::Mul(paths, density), facing_light));
  return hn::Div(connected, hn::Mul(scattered, set(1 / kPi)));
}

template <typename T, typename F>
auto Caustics<T, F>::weight(const Paths& paths, const Hit& hit, const Interaction& at,
                            Bits leaf) const -> V {
  const D d;
  const DU du;
  const V one = set(1);
  const Mask is_light = hn::And(hn::And(at.is_hit, is(paths.chain, word(Paths::kLeft))),
                                hn::RebindMask(d, hn::Ne(leaf, word(kNoLight))));
  if (hn::AllFalse(d, is_light)) return one;
  const auto known = [&](Bits of) HWY_ATTR {
    return hn::IfThenElseZero(hn::RebindMask(du, is_light), of);
  };
  const Caster by = caster(known(paths.caster), paths.time);
  const Light light = this->light(known(leaf), paths.time);
  const Cap seen = cap(by, light);
  const Triple<V> y = plus_scaled(paths.origin, paths.direction, hit.distance);
  const Ends of = ends(paths.start, y, by);
  const SphereSweep<T> sweep(of.a, of.b, hn::Max(by.index, one), paths.chords);
  const V count = sweep.count(sweep.range(), of.angle);
  const V cosine = hn::Sqrt(hn::Max(hn::NegMulAdd(paths.impact, paths.impact, one), hn::Zero(d)));
  const V density = sweep.density({paths.impact, cosine}, of.sine);
  V chosen = Lights(scene_.casters)
                 .probability(is_light, known(paths.caster),
                              {paths.start, paths.start_normal, paths.time});
  chosen = hn::Mul(chosen, hn::Mul(light.probability, chance_of_chords(paths.chords, by.index)));
  const V ratio = odds(chosen, hn::Max(count, one), density, hn::Abs(at.cosine),
                       hn::Mul(paths.start_cosine, paths.passed), by, light, seen);
  const Mask counts = hn::And(hn::And(is_light, seen.exists), hn::Gt(of.b, one));
  return hn::IfThenElse(counts, hn::Div(one, hn::Add(one, ratio)), one);
}

template <typename T, typename F>
void Caustics<T, F>::follow(Paths& paths, const Hit& hit, const Interaction& at,
                            const BsdfSample& scattered) const {
  const D d;
  const DU du;
  const V one = set(1);
  const Mask is_open = hn::RebindMask(d, hn::Ne(paths.chain, hn::Zero(du)));
  if (hn::AllFalse(d, hn::Or(paths.light_sampled, is_open))) return;

  const Bits leaf = at.by_slot(scene_.casters.leaf_of_slot);
  const Mask is_caster = hn::And(at.is_hit, hn::RebindMask(d, hn::Ne(leaf, word(kNoLight))));
  const Mask enters = hn::And(is_caster, paths.light_sampled);
  const Mask inside = hn::And(hn::And(is_caster, is(paths.chain, word(Paths::kInside))),
                              is(leaf, paths.caster));
  const Mask mirrors = Bsdf<T>::has(at.surface, kMirrors);
  const Mask reflects = hn::Or(mirrors, scattered.reflected);
  const V share = hn::IfThenElse(
      mirrors, one,
      hn::IfThenElse(scattered.reflected, scattered.reflectance,
                     hn::Sub(one, scattered.reflectance)));

  const Triple<V> to_start = minus(paths.origin, at.center);
  const Triple<V> beside = minus_scaled(to_start, paths.direction, dot(to_start, paths.direction));
  const V impact = hn::Min(hn::Div(length(beside), at.by_slot(scene_.radius)), one);
  const auto keep = [&](V& value, V entered) HWY_ATTR {
    value = hn::IfThenElse(enters, entered, value);
  };
  keep(paths.impact, impact);
  keep(paths.start_cosine, hn::Abs(hit.cosine));
  keep(paths.passed, one);
  keep(paths.chords, hn::Zero(d));
  const Triple<V> facing = flipped(paths.normal, hn::And(hit.cosine, hn::SignBit(d)));
  paths.start = choose(enters, paths.origin, paths.start);
  paths.start_normal = choose(enters, facing, paths.start_normal);
  const auto entering = hn::RebindMask(du, enters);
  paths.caster = hn::IfThenElse(entering, leaf, paths.caster);
  paths.passed = hn::Mul(paths.passed, share);
  paths.chords = hn::Add(paths.chords, hn::IfThenElseZero(inside, one));

  const Mask goes_in = hn::Or(hn::AndNot(reflects, enters), hn::And(reflects, inside));
  const Mask goes_out = hn::Or(hn::And(reflects, enters), hn::AndNot(reflects, inside));
  const auto to = [&](Mask mask, std::uint32_t state) HWY_ATTR {
    return hn::IfThenElseZero(hn::RebindMask(du, mask), word(state));
  };
  paths.chain = hn::Or(to(goes_in, Paths::kInside), to(goes_out, Paths::kLeft));
}

template <typename T, typename F>
auto Caustics<T, F>::connect(Mask wanted, const Paths& paths, Triple<V> facing,
                             const LaneSampler<D>& sampler) const -> Connection {
  const D d;
  const DU du;
  const V one = set(1), zero = hn::Zero(d);
  const Place x{paths.origin, facing, paths.time};
  const auto chosen = Lights(scene_.casters).choose_leaf(wanted, x, sampler, kCaster);
  const auto [of_light, of_chords] = sampler.pair(kCausticLight);
  const auto [height, turn] = sampler.pair(kCausticPoint);
  const V of_path = sampler.pair(kCaster).second;

  Mask active = hn::And(wanted, hn::Gt(chosen.probability, zero));
  const Caster by =
      caster(hn::IfThenElseZero(hn::RebindMask(du, active), chosen.leaf), paths.time);
  const Light light = this->light(choose_light(of_light), paths.time);
  const Cap seen = cap(by, light);
  const V below = hn::Mul(height, seen.height);
  const Triple<V> normal = around(seen.axis, hn::Sub(one, below),
                                  hn::Mul(below, hn::Sub(set(2), below)), turn);
  const Triple<V> y = plus_scaled(light.center, normal, light.radius);

  const V chords = choose_chords(of_chords, by.index);
  const V to_x = length(minus(paths.origin, by.center));
  active = hn::And(active, hn::And(seen.exists, hn::Ge(to_x, by.radius)));
  active = hn::And(active, hn::Lt(chords, set(kMaxChords + 0.5)));
  active = hn::And(active, hn::Le(hn::Add(chords, set(2)), number(paths.depth_left)));
  if (hn::AllFalse(d, active)) return {active, facing, light.slot};
  const Ends of = ends(paths.origin, y, by);
  const SphereSweep<T> sweep(of.a, of.b, hn::Max(by.index, one), chords);
  const auto range = sweep.range();
  const V count = sweep.count(range, of.angle);
  active = hn::And(active, hn::Gt(count, set(0.5)));
  const V rank = hn::Min(hn::Floor(hn::Mul(of_path, count)), hn::Sub(count, one));
  const auto path = sweep.find(range, of.angle, rank);

  const V slant = hn::Div(path.at.sine, of.a);
  const V along = hn::Sqrt(hn::Max(hn::NegMulAdd(slant, slant, one), zero));
  Triple<V> direction =
      plus_scaled(scaled(of.towards, along), of.across, hn::Mul(path.side, slant));
  const V start_cosine = dot(direction, facing);
  active = hn::And(active, hn::Gt(start_cosine, zero));
  if (hn::AllFalse(d, active)) return {active, facing, light.slot};

  Triple<V> position = paths.origin, surface_normal = paths.normal, attenuation{one, one, one};
  Bits departed = paths.departed;
  V radius = paths.radius, passed = one, left = hn::Add(chords, one), facing_light = one;
  const TableReader<D> by_optics = interactions_.optics_of(by.slot);
  const Bits surface = by_optics(scene_.bsdf.surface);
  const Bsdf<T> bsdf(scene_.bsdf, by_optics);
  const Mask is_mirror = Bsdf<T>::has(surface, kMirrors);
  Mask arrived = hn::MaskFromVec(zero);
  while (!hn::AllFalse(d, active)) {
    const V rehit = rehit_distance(dot(direction, surface_normal), radius);
    const auto nearest =
        Search(scene_).find(position, direction, paths.time, departed, rehit, active, tests_);
    counts_.rays += hn::CountTrue(d, active);
    const Mask is_last = hn::And(active, hn::Lt(left, set(0.5)));
    if (!hn::AllFalse(d, is_last)) {
      const V distance = dot(minus(y, position), direction);
      const Mask occluded = hn::AndNot(is(nearest.index, light.slot), hn::Lt(nearest.t, distance));
      const V cosine = hn::Neg(dot(direction, normal));
      facing_light = hn::IfThenElse(is_last, cosine, facing_light);
      arrived = hn::Or(arrived, hn::And(hn::AndNot(occluded, is_last), hn::Gt(cosine, zero)));
    }
    active = hn::And(hn::AndNot(is_last, active), is(nearest.index, by.slot));
    if (hn::AllFalse(d, active)) break;

    const Mask is_rehit = is(departed, by.slot);
    Triple<V> outward = plus_scaled(minus(position, by.center), direction, nearest.t);
    const V before = dot(direction, surface_normal);
    outward = choose(is_rehit,
                     minus_scaled(surface_normal, direction, hn::Add(before, before)), outward);
    outward = scaled(outward, hn::Div(one, length(outward)));
    const V cosine = dot(direction, outward);
    const Mask enters = hn::Lt(cosine, zero);
    const Triple<V> inward = flipped(outward, hn::AndNot(cosine, hn::SignBit(d)));
    const auto glass = bsdf.boundary(direction, inward, cosine, surface);
    const Mask is_end = hn::Lt(left, set(1.5));
    const Mask refracts =
        hn::AndNot(is_mirror, hn::And(hn::Gt(chords, set(0.5)), hn::Or(enters, is_end)));
    const V share = hn::IfThenElse(refracts, hn::Sub(one, glass.reflectance),
                                   hn::IfThenElse(is_mirror, one, glass.reflectance));
    passed = hn::IfThenElse(active, hn::Mul(passed, share), passed);
    attenuation = choose(active, product(attenuation, by.color), attenuation);
    const Triple<V> mirrored = minus_scaled(direction, outward, hn::Add(cosine, cosine));
    direction = choose(refracts, glass.refracted, mirrored);
    direction = scaled(direction, hn::Div(one, length(direction)));
    position = plus_scaled(by.center, outward, by.radius);
    surface_normal = outward;
    departed = by.slot;
    radius = by.radius;
    left = hn::Sub(left, hn::IfThenElseZero(active, one));
  }
  const V density = sweep.density(path.at, of.sine);
  const V choice = hn::Mul(hn::Mul(chosen.probability, light.probability),
                           chance_of_chords(chords, by.index));
  const V ratio = odds(choice, count, density, facing_light, hn::Mul(start_cosine, passed), by,
                       light, seen);
  arrived = hn::And(arrived, hn::Gt(passed, zero));
  const V weight = hn::Div(one, hn::Add(one, ratio));
  return {arrived, scaled(product(light.radiance, attenuation), weight), light.slot};
}

}  // namespace sdlc::render::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
