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

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>

#include <hwy/highway.h>

#include "render/film/trace_counts.hpp"
#include "render/kernel/glints-inl.h"
#include "render/kernel/interaction-inl.h"
#include "render/kernel/nearest-inl.h"
#include "render/kernel/paths-inl.h"
#include "render/kernel/wide_scene.hpp"
#include "render/lanes/table_reader-inl.h"
#include "render/lanes/vector_math-inl.h"
#include "render/shading/beams-inl.h"
#include "render/shading/bsdf-inl.h"
#include "render/shading/lane_sampler-inl.h"
#include "render/shading/light_sampler-inl.h"
#include "render/shading/sampler.hpp"

HWY_BEFORE_NAMESPACE();
namespace sdlc::render::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Connections to lights by way of one caster, which is a smooth mirror or a ball of glass: from a
/// diffuse surface, where the light is a caustic, and from the camera, where it is a glint.
///
/// At a diffuse surface, a connection chooses a caster, a light and a number of chords, then one of
/// the beams (Beams) and a direction in it, uniformly in solid angle. At the camera it chooses one
/// of the pixel's glints and a place in it. The ray is then followed: it counts if it meets the
/// light. The balance heuristic weighs that against scattered rays, or camera rays, that take the
/// same path: both techniques have the weight p_b / (p_b + p_m), with p_b their density (cos/π, or
/// 1 per pixel) times the reflectances and transmittances along the path, and p_m the density of
/// the connection. p_m is bounded, so the weights are; and beams and glints that are not exact cost
/// time only.
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

  HWY_INLINE Caustics(const WideScene<T>& scene, const WideView<T>& view,
                      const Interactions<T, F>& interactions, SphereTests& tests,
                      TraceCounts& counts)
      : scene_(scene),
        view_(view),
        interactions_(interactions),
        tests_(tests),
        counts_(counts),
        glints_(view.glints, view.width, view.height) {}

  /// The weight of the emission that the paths find; 1 for those that no connection could find.
  /// `leaf`: of the light that was hit, or kNoLight.
  HWY_NOINLINE V weight(const Paths& paths, const Interaction& at, Bits leaf) const;
  /// Records what the paths have met since the last diffuse surface. Before the paths depart.
  HWY_INLINE void follow(Paths& paths, const Hit& hit, const Interaction& at,
                         const BsdfSample& scattered) const;

  struct Connection {
    Mask exists;         ///< the other members are undefined elsewhere
    Triple<V> radiance;  ///< contribution without the attenuation of the diffuse surface
    V weight;            ///< of scattered rays that take the same path
    Bits slot;           ///< of the light
  };
  /// For the lanes of `wanted`, which leave a diffuse surface. `facing`: the normal on the side of
  /// the path.
  HWY_NOINLINE Connection connect(Mask wanted, const Paths& paths, Triple<V> facing,
                                  const LaneSampler<D>& sampler) const;
  /// For paths that are about to leave the camera.
  template <typename Runs>
  HWY_INLINE Connection connect_to_camera(Paths& paths, const Runs& runs) {
    if (HWY_LIKELY(glints_.empty())) return nothing();
    return connect_glints(paths, runs);
  }

 private:
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
  /// A ray at its origin, which is on a sphere.
  struct Start {
    Triple<V> origin, direction, normal;
    Bits departed;
    V radius, time;
  };
  /// What a ray meets on its way by the caster to the light.
  struct Way {
    Mask arrived;
    V passed;  // the product of reflectances and transmittances
    Triple<V> attenuation;
  };
  struct GlintSample {
    V x, y, chords;
    Bits caster, light;
  };
  using Word = hn::TFromD<DU>;
  static constexpr std::size_t kLanes = hn::MaxLanes(D());
  using Numbers = std::array<T, kLanes>;
  using Words = std::array<Word, kLanes>;

  static HWY_INLINE V set(double v) { return hn::Set(D(), static_cast<T>(v)); }
  static HWY_INLINE Connection nothing() {
    const V zero = hn::Zero(D());
    return {hn::MaskFromVec(zero), {zero, zero, zero}, zero, word(0)};
  }
  static HWY_INLINE Connection connection(const Way& way, const Light& light, V weight) {
    return {.exists = hn::And(way.arrived, hn::Gt(way.passed, hn::Zero(D()))),
            .radiance = scaled(product(light.radiance, way.attenuation), weight),
            .weight = weight,
            .slot = light.slot};
  }
  static HWY_INLINE Start start_of(const Paths& paths, Triple<V> direction) {
    return {.origin = paths.origin,
            .direction = direction,
            .normal = paths.normal,
            .departed = paths.departed,
            .radius = paths.radius,
            .time = paths.time};
  }
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
  HWY_INLINE Bits choose_light(V u, V of_lower_levels) const;
  static HWY_INLINE V choose_chords(V u, V index);
  static HWY_INLINE V chance_of_chords(V chords, V index);
  static HWY_INLINE Beams<T> beams(Triple<V> x, const Caster& by, const Light& light, V chords) {
    return Beams<T>(x, {by.center, by.radius}, {light.center, light.radius},
                    hn::Max(by.index, set(1)), chords);
  }
  HWY_INLINE V weight_at_surface(Mask counts, const Paths& paths, Bits leaf) const;
  HWY_INLINE V weight_at_camera(Mask counts, const Paths& paths, Bits leaf) const;
  /// Of places in a pixel, by LaneGlints; 0 outside of `mask`.
  HWY_NOINLINE V density(Mask mask, const GlintSample& sample) const;
  template <typename Runs>
  HWY_NOINLINE Connection connect_glints(Paths& paths, const Runs& runs);
  HWY_NOINLINE Way follow_to_light(Mask active, const Start& start, const Caster& by, V chords,
                                   Bits light) const;

  const WideScene<T>& scene_;
  const WideView<T>& view_;
  const Interactions<T, F>& interactions_;
  SphereTests& tests_;
  TraceCounts& counts_;
  LaneGlints<T> glints_;
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
auto Caustics<T, F>::choose_light(V u, V of_lower_levels) const -> Bits {
  const WideLights<T>& lights = scene_.lights;
  Bits node = word(1);
  for (int level = 0; level < lights.levels; ++level) {
    if (level == LightTree::kLevelsPerNumber) u = of_lower_levels;
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

/// The number of chords in glass: 1 for three quarters of the connections, 0 for an eighth, and N >
/// 1 for 2^-(N + 2), which falls as the light does.
template <typename T, typename F>
auto Caustics<T, F>::choose_chords(V u, V index) -> V {
  const V one = set(1), zero = hn::Zero(D());
  V chords = hn::IfThenElseZero(hn::Lt(u, set(0.75)), one);
  double limit = 0.875;
  for (std::uint32_t n = 2; n <= kMaxChords + 1; ++n) {
    chords = hn::IfThenElse(hn::Ge(u, set(limit)), set(n), chords);
    limit = (1 + limit) / 2;
  }
  return hn::IfThenElseZero(hn::Gt(index, zero), chords);
}

template <typename T, typename F>
auto Caustics<T, F>::chance_of_chords(V chords, V index) -> V {
  V chance = hn::IfThenElse(hn::Lt(chords, set(0.5)), set(0.125), set(0.75));
  double of = 0.125;
  for (std::uint32_t n = 2; n <= kMaxChords + 1; ++n) {
    of = n > kMaxChords ? 0 : of / 2;
    chance = hn::IfThenElse(hn::Gt(chords, set(n - 0.5)), set(of), chance);
  }
  return hn::IfThenElse(hn::Gt(index, hn::Zero(D())), chance, set(1));
}

template <typename T, typename F>
auto Caustics<T, F>::weight(const Paths& paths, const Interaction& at, Bits leaf) const -> V {
  const D d;
  const V one = set(1);
  Mask counts = hn::And(hn::And(at.is_hit, is(paths.chain, word(Paths::kLeft))),
                        hn::RebindMask(d, hn::Ne(leaf, word(kNoLight))));
  counts = hn::And(counts, hn::Le(paths.chords, set(kMaxChords)));
  V weight = one;
  const Mask at_camera = hn::And(counts, paths.is_from_camera);
  if (!hn::AllFalse(d, at_camera)) weight = weight_at_camera(at_camera, paths, leaf);
  const Mask at_surface = hn::AndNot(paths.is_from_camera, counts);
  if (hn::AllFalse(d, at_surface)) return weight;
  return hn::IfThenElse(at_surface, weight_at_surface(at_surface, paths, leaf), weight);
}

template <typename T, typename F>
auto Caustics<T, F>::weight_at_surface(Mask counts, const Paths& paths, Bits leaf) const -> V {
  const D d;
  const V one = set(1);
  const auto known = [&](Bits of)
                         HWY_ATTR { return hn::IfThenElseZero(hn::RebindMask(DU(), counts), of); };
  const Caster by = caster(known(paths.caster), paths.time);
  const Light light = this->light(known(leaf), paths.time);
  const Beams<T> beams = this->beams(paths.start, by, light, paths.chords);
  const auto found = beams.find(paths.start_direction);
  counts = hn::And(counts, hn::And(beams.exist(), found.contains));
  if (hn::AllFalse(d, counts)) return one;
  V chosen =
      Lights(scene_.casters)
          .probability(counts, known(paths.caster), {paths.start, paths.start_normal, paths.time});
  chosen = hn::Mul(chosen, hn::Mul(light.probability, chance_of_chords(paths.chords, by.index)));
  const V connected = hn::Div(chosen, hn::Mul(beams.count(), found.beam.solid_angle));
  const V cosine = dot(paths.start_direction, paths.start_normal);
  const V scattered = hn::Mul(hn::Mul(cosine, paths.passed), set(1 / kPi));
  return hn::IfThenElse(counts, hn::Div(scattered, hn::Add(scattered, connected)), one);
}

template <typename T, typename F>
auto Caustics<T, F>::weight_at_camera(Mask counts, const Paths& paths, Bits leaf) const -> V {
  const V connected = density(counts, {.x = paths.in_pixel_x,
                                       .y = paths.in_pixel_y,
                                       .chords = paths.chords,
                                       .caster = paths.caster,
                                       .light = leaf});
  return hn::IfThenElse(hn::Gt(connected, hn::Zero(D())),
                        hn::Div(paths.passed, hn::Add(paths.passed, connected)), set(1));
}

template <typename T, typename F>
auto Caustics<T, F>::density(Mask mask, const GlintSample& sample) const -> V {
  const D d;
  const DU du;
  alignas(64) Numbers x, y, chords, density{};
  alignas(64) Words caster, light;
  hn::Store(sample.x, d, x.data());
  hn::Store(sample.y, d, y.data());
  hn::Store(sample.chords, d, chords.data());
  hn::Store(sample.caster, du, caster.data());
  hn::Store(sample.light, du, light.data());
  for (std::uint32_t lanes = bits_of(d, mask); lanes != 0; lanes &= lanes - 1) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(lanes));
    density[lane] = glints_.density(lane, static_cast<std::uint32_t>(caster[lane]),
                                    static_cast<std::uint32_t>(light[lane]),
                                    static_cast<std::uint32_t>(chords[lane]), x[lane], y[lane]);
  }
  return hn::Load(d, density.data());
}

template <typename T, typename F>
void Caustics<T, F>::follow(Paths& paths, const Hit& hit, const Interaction& at,
                            const BsdfSample& scattered) const {
  const D d;
  const DU du;
  const V one = set(1);
  const Mask is_open = hn::RebindMask(d, hn::Ne(paths.chain, hn::Zero(du)));
  const Mask left_diffuse = paths.left_diffuse();
  if (hn::AllFalse(d, hn::Or(left_diffuse, is_open))) return;

  const Bits leaf = at.by_slot(scene_.casters.leaf_of_slot);
  const Mask is_caster = hn::And(at.is_hit, hn::RebindMask(d, hn::Ne(leaf, word(kNoLight))));
  const Mask at_camera = is(paths.chain, word(Paths::kAtCamera));
  const Mask enters = hn::And(is_caster, hn::Or(left_diffuse, at_camera));
  const Mask inside =
      hn::And(hn::And(is_caster, is(paths.chain, word(Paths::kInside))), is(leaf, paths.caster));
  const Mask mirrors = Bsdf<T>::has(at.surface, kMirrors);
  const Mask reflects = hn::Or(mirrors, scattered.reflected);
  const V share = hn::IfThenElse(mirrors, one,
                                 hn::IfThenElse(scattered.reflected, scattered.reflectance,
                                                hn::Sub(one, scattered.reflectance)));

  const auto keep = [&](V& value, V entered)
                        HWY_ATTR { value = hn::IfThenElse(enters, entered, value); };
  keep(paths.passed, one);
  keep(paths.chords, hn::Zero(d));
  const Triple<V> facing = flipped(paths.normal, hn::And(hit.cosine, hn::SignBit(d)));
  paths.start = choose(enters, paths.origin, paths.start);
  paths.start_normal = choose(enters, facing, paths.start_normal);
  paths.start_direction = choose(enters, paths.direction, paths.start_direction);
  paths.is_from_camera =
      hn::Or(hn::And(enters, at_camera), hn::AndNot(enters, paths.is_from_camera));
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
  const auto [height, turn] = sampler.pair(kCausticDirection);
  const auto [of_beam, of_lower_levels] = sampler.pair(kBeam);

  Mask active = hn::And(wanted, hn::Gt(chosen.probability, zero));
  const Caster by = caster(hn::IfThenElseZero(hn::RebindMask(du, active), chosen.leaf), paths.time);
  const Light light = this->light(choose_light(of_light, of_lower_levels), paths.time);
  const V chords = choose_chords(of_chords, by.index);
  active = hn::And(active, hn::Lt(chords, set(kMaxChords + 0.5)));
  active = hn::And(active, hn::Le(hn::Add(chords, set(2)), number(paths.depth_left)));
  if (hn::AllFalse(d, active)) return nothing();
  const Beams<T> beams = this->beams(paths.origin, by, light, chords);
  active = hn::And(active, beams.exist());
  const V last = hn::Sub(beams.count(), one);
  const auto beam = beams.beam(hn::Min(hn::Floor(hn::Mul(of_beam, beams.count())), last));
  active = hn::And(active, hn::Gt(beam.solid_angle, zero));
  const Triple<V> direction = beams.direction(beam, height, turn);
  const V cosine = dot(direction, facing);
  active = hn::And(active, hn::Gt(cosine, zero));
  if (hn::AllFalse(d, active)) return nothing();

  const Way way = follow_to_light(active, start_of(paths, direction), by, chords, light.slot);
  const V choice =
      hn::Mul(hn::Mul(chosen.probability, light.probability), chance_of_chords(chords, by.index));
  const V connected = hn::Div(choice, hn::Mul(beams.count(), beam.solid_angle));
  const V scattered = hn::Mul(hn::Mul(cosine, way.passed), set(1 / kPi));
  return connection(way, light, hn::Div(scattered, hn::Add(scattered, connected)));
}

template <typename T, typename F>
template <typename Runs>
auto Caustics<T, F>::connect_glints(Paths& paths, const Runs& runs) -> Connection {
  const D d;
  const DU du;
  const V one = set(1);
  alignas(64) Numbers choice, across, up, x{}, y{}, chords{};
  alignas(64) Words caster{}, leaf{}, exists{};
  const LaneSampler<D> sampler = paths.sampler(view_.sampler, runs.mixer());
  const auto place = sampler.pair(kGlintPlace);
  hn::Store(sampler.first(kGlint), d, choice.data());
  hn::Store(place.first, d, across.data());
  hn::Store(place.second, d, up.data());
  for (std::uint32_t lanes = bits_of(d, paths.fresh); lanes != 0; lanes &= lanes - 1) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(lanes));
    if (!glints_.start(lane, runs.run(lane).pixel)) continue;
    const auto sample = glints_.sample(lane, choice[lane], across[lane], up[lane]);
    exists[lane] = 1;
    x[lane] = sample.x;
    y[lane] = sample.y;
    chords[lane] = static_cast<T>(sample.glint->chords);
    caster[lane] = sample.glint->caster;
    leaf[lane] = sample.glint->light;
  }
  Mask active = hn::RebindMask(d, hn::Ne(hn::Load(du, exists.data()), hn::Zero(du)));
  paths.chain = hn::IfThenElse(hn::RebindMask(du, active), word(Paths::kAtCamera), paths.chain);
  const GlintSample sample{.x = hn::Load(d, x.data()),
                           .y = hn::Load(d, y.data()),
                           .chords = hn::Load(d, chords.data()),
                           .caster = hn::Load(du, caster.data()),
                           .light = hn::Load(du, leaf.data())};
  active = hn::And(active, hn::Le(hn::Add(sample.chords, set(2)), number(paths.depth_left)));
  if (hn::AllFalse(d, active)) return nothing();

  const Caster by = this->caster(sample.caster, paths.time);
  const Light light = this->light(sample.light, paths.time);
  const Triple<V> right = spread(d, view_.spread_right), upwards = spread(d, view_.spread_up);
  const Triple<V> on_plane =
      plus_scaled(plus_scaled(runs.corner(), right, sample.x), upwards, sample.y);
  const Triple<V> direction = scaled(on_plane, hn::Div(one, length(on_plane)));
  const Way way =
      follow_to_light(active, start_of(paths, direction), by, sample.chords, light.slot);
  const V connected = density(way.arrived, sample);
  return connection(way, light, hn::Div(way.passed, hn::Add(way.passed, connected)));
}

template <typename T, typename F>
auto Caustics<T, F>::follow_to_light(Mask active, const Start& start, const Caster& by, V chords,
                                     Bits light) const -> Way {
  const D d;
  const V one = set(1), zero = hn::Zero(d);
  Triple<V> position = start.origin, direction = start.direction;
  Triple<V> surface_normal = start.normal, attenuation{one, one, one};
  Bits departed = start.departed;
  V radius = start.radius, passed = one, left = hn::Add(chords, one);
  const TableReader<D> by_optics = interactions_.optics_of(by.slot);
  const Bits surface = by_optics(scene_.bsdf.surface);
  const Bsdf<T> bsdf(scene_.bsdf, by_optics);
  const Mask is_mirror = Bsdf<T>::has(surface, kMirrors);
  Mask arrived = hn::MaskFromVec(zero);
  while (!hn::AllFalse(d, active)) {
    const V rehit = rehit_distance(dot(direction, surface_normal), radius);
    const auto nearest =
        Search(scene_).find(position, direction, start.time, departed, rehit, active, tests_);
    counts_.rays += hn::CountTrue(d, active);
    if constexpr (F::kPilot) view_.plain->caustic_rays += hn::CountTrue(d, active);
    const Mask is_last = hn::And(active, hn::Lt(left, set(0.5)));
    const Mask is_hit = hn::Lt(nearest.t, hn::Set(d, std::numeric_limits<T>::infinity()));
    active = hn::And(active, is_hit);
    arrived = hn::Or(arrived, hn::And(hn::And(is_last, is_hit), is(nearest.index, light)));
    active = hn::And(hn::AndNot(is_last, active), is(nearest.index, by.slot));
    if (hn::AllFalse(d, active)) break;

    const Mask is_rehit = is(departed, by.slot);
    Triple<V> outward = plus_scaled(minus(position, by.center), direction, nearest.t);
    const V before = dot(direction, surface_normal);
    outward =
        choose(is_rehit, minus_scaled(surface_normal, direction, hn::Add(before, before)), outward);
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
  return {.arrived = arrived, .passed = passed, .attenuation = attenuation};
}

}  // namespace sdlc::render::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
