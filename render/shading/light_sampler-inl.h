// Next event estimation. Compiled once per instruction set, so it has no
// include guard but Highway's.
// clang-format off
#if defined(SDLC_RENDER_SHADING_LIGHT_SAMPLER_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SDLC_RENDER_SHADING_LIGHT_SAMPLER_INL_H
#undef SDLC_RENDER_SHADING_LIGHT_SAMPLER_INL_H
#else
#define SDLC_RENDER_SHADING_LIGHT_SAMPLER_INL_H
#endif
// clang-format on

#include <cstdint>
#include <limits>

#include <hwy/highway.h>

#include "render/lanes/table_reader-inl.h"
#include "render/lanes/vector_math-inl.h"
#include "render/shading/lane_sampler-inl.h"
#include "render/shading/light_tree.hpp"
#include "render/shading/sampler.hpp"
#include "render/shading/wide_lights.hpp"

HWY_BEFORE_NAMESPACE();
namespace sdlc::render::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// From this sin² of the half angle on, the light fills two thirds of the sky or contains the point:
/// scattering finds it anyway.
inline constexpr double kLargestLightSine2 = 0.9;

/// Chooses lights by LightTree, and directions in the cone in which the light is seen (Shirley,
/// Wang, Zimmerman, "Monte Carlo techniques for direct lighting calculations", 1996, 3.2).
template <typename T, bool kMotion>
class LightSampler {
 public:
  using D = Lanes<T>;
  using DU = hn::RebindToUnsigned<D>;
  using V = hn::Vec<D>;
  using Bits = hn::Vec<DU>;
  using Mask = hn::Mask<D>;

  /// A point on a surface. `normal` is on the side from which the path came.
  struct Place {
    Triple<V> x, normal;
    V time;
  };
  /// A shadow ray towards a light.
  struct Sample {
    Mask exists;  ///< a light may be visible; the other members are undefined elsewhere
    Triple<V> direction;
    V distance;          ///< an occluder is nearer than this
    Triple<V> radiance;  ///< contribution if unoccluded, without the attenuation of the surface
    V bsdf_weight;       ///< share of the light's radiance in this contribution
    Bits slot;
  };

  explicit HWY_INLINE LightSampler(const WideLights<T>& lights) : lights_(lights) {}

  /// For the lanes of `wanted`. `scattering(direction, cosine)` is π times the density with which
  /// the surface scatters into a direction; the cosine is that to the normal.
  template <typename Density>
  HWY_INLINE Sample sample(Mask wanted, const Place& at, const LaneSampler<D>& sampler,
                           const Density& scattering) const;
  /// The weight of scattered rays that hit the light of a leaf, for the lanes of `is_light`.
  /// `scattering`: π times the density of their direction.
  HWY_INLINE V bsdf_weight(Mask is_light, Bits leaf, const Place& at, V scattering) const;

  struct Choice {
    Bits leaf;
    V probability;  ///< 0: no light
  };
  /// Chooses a light by what it may send to a place, with the random numbers of `pair`.
  HWY_INLINE Choice choose_leaf(Mask wanted, const Place& at, const LaneSampler<D>& sampler,
                                std::uint32_t pair) const;
  /// The probability of that, for the lanes of `is_light`; 0 if the leaf is never chosen.
  HWY_INLINE V probability(Mask is_light, Bits leaf, const Place& at) const;

 private:
  struct Children {
    V share_left, share_right;
    Mask any;  // at least one may be chosen
  };
  struct Cone {
    Triple<V> to_center;
    V distance;  // to the centre
    V height;    // 1 − cos of the half angle; the solid angle is 2π times this
    V radius_squared;
    Mask exists;
  };

  static HWY_INLINE V set(double v) { return hn::Set(D(), static_cast<T>(v)); }
  static HWY_INLINE Bits word(std::uint32_t v) { return hn::Set(DU(), v); }

  HWY_INLINE V importance(Bits node, const Place& at) const;
  HWY_INLINE Children children(Bits left, const Place& at) const;
  HWY_INLINE Cone cone(const TableReader<D>& read, const Place& at) const;
  static HWY_INLINE V balance_heuristic(V probability, const Cone& cone, V scattering);

  const WideLights<T>& lights_;
};

/// An upper bound, up to a constant factor, on the light that a node sends to a point: power · cos
/// θ / d². The cosine is that of the highest point of the bounding sphere above the horizon; the
/// bound is 0 if all of it is below.
template <typename T, bool kMotion>
auto LightSampler<T, kMotion>::importance(Bits node, const Place& at) const -> V {
  const D d;
  const TableReader<D> read(node, lights_.nodes);
  const Triple<V> to_center = minus(read(lights_.node_center), at.x);
  const V radius = read(lights_.node_radius);
  const V height = hn::Add(dot(to_center, at.normal), radius);
  const V distance = hn::Max(hn::Sqrt(dot(to_center, to_center)), radius);
  const V cube = hn::Mul(hn::Mul(distance, distance), distance);
  return hn::IfThenElseZero(hn::Gt(height, hn::Zero(d)),
                            hn::Div(hn::Mul(read(lights_.node_power), height), cube));
}

/// For the node whose left child is `left`. None may be chosen if no light arrives from either, or
/// if the point is so near that the bounds overflow.
template <typename T, bool kMotion>
auto LightSampler<T, kMotion>::children(Bits left, const Place& at) const -> Children {
  const D d;
  const V of_left = importance(left, at), of_right = importance(hn::Add(left, word(1)), at);
  const V total = hn::Add(of_left, of_right);
  const V infinity = hn::Set(d, std::numeric_limits<T>::infinity());
  return {hn::Div(of_left, total), hn::Div(of_right, total),
          hn::And(hn::Gt(total, hn::Zero(d)), hn::Lt(total, infinity))};
}

template <typename T, bool kMotion>
auto LightSampler<T, kMotion>::choose_leaf(Mask wanted, const Place& at,
                                           const LaneSampler<D>& sampler, std::uint32_t pair) const
    -> Choice {
  const D d;
  const DU du;
  V u = sampler.first(pair);
  V probability = hn::IfThenElseZero(wanted, set(1));
  Bits node = word(1);
  for (int level = 0; level < lights_.levels; ++level) {
    if (level == LightTree::kLevelsPerNumber) u = sampler.pair(pair).second;
    const Bits left = hn::Add(node, node);
    Children shares = children(left, at);
    const Mask goes_left = hn::Lt(u, shares.share_left);
    const V share = hn::IfThenElse(goes_left, shares.share_left, shares.share_right);
    u = hn::Div(hn::IfThenElse(goes_left, u, hn::Sub(u, shares.share_left)), share);
    probability = hn::IfThenElseZero(shares.any, hn::Mul(probability, share));
    node = hn::Add(left, hn::IfThenZeroElse(hn::RebindMask(du, goes_left), word(1)));
  }
  return {hn::Sub(node, word(lights_.leaves)),
          hn::IfThenElseZero(hn::Gt(probability, hn::Zero(d)), probability)};
}

template <typename T, bool kMotion>
auto LightSampler<T, kMotion>::cone(const TableReader<D>& read, const Place& at) const -> Cone {
  const V one = set(1);
  Triple<V> center = read(lights_.center);
  if constexpr (kMotion) center = plus_scaled(center, read(lights_.shift), at.time);
  const Triple<V> to_center = minus(center, at.x);
  const V distance_squared = dot(to_center, to_center);
  const V radius = read(lights_.radius), radius_squared = hn::Mul(radius, radius);
  const V sine_squared = hn::Div(radius_squared, distance_squared);
  // 1 − √(1 − s) would cancel for small lights.
  const V height = hn::Div(sine_squared, hn::Add(one, hn::Sqrt(hn::Sub(one, sine_squared))));
  return {to_center, hn::Sqrt(distance_squared), height, radius_squared,
          hn::And(hn::Lt(sine_squared, set(kLargestLightSine2)), hn::Gt(height, hn::Zero(D())))};
}

/// The balance heuristic (Veach, "Robust Monte Carlo methods for light transport simulation", 1997,
/// 9.2.2) for scattering versus sampling the light (chosen with this probability, with a direction
/// in its cone): the density of scattering divided by the sum of it and probability over solid
/// angle. A scattered ray that hits the light has this weight. A connection also counts as its
/// radiance times this: the weight of its own technique times the density of scattering over its
/// own is the same number. Valid if there is a cone and the probability is above 0.
template <typename T, bool kMotion>
auto LightSampler<T, kMotion>::balance_heuristic(V probability, const Cone& cone, V scattering)
    -> V {
  const V scattered = hn::Mul(hn::Add(cone.height, cone.height), scattering);
  return hn::Div(scattered, hn::Add(probability, scattered));
}

template <typename T, bool kMotion>
template <typename Density>
auto LightSampler<T, kMotion>::sample(Mask wanted, const Place& at, const LaneSampler<D>& sampler,
                                      const Density& scattering) const -> Sample {
  const D d;
  const V one = set(1), zero = hn::Zero(d);
  Choice chosen = choose_leaf(wanted, at, sampler, kChoice);
  const TableReader<D> read(chosen.leaf, lights_.leaves);
  Cone seen = cone(read, at);

  auto [height, turn] = sampler.pair(kLight);
  const V below = hn::Mul(height, seen.height);
  const V cosine = hn::Sub(one, below);
  const V sine_squared = hn::Mul(below, hn::Sub(set(2), below));
  const Triple<V> axis = scaled(seen.to_center, hn::Div(one, seen.distance));
  const Triple<V> direction = around(axis, cosine, sine_squared, turn);
  const V across_squared = hn::Mul(hn::Mul(seen.distance, seen.distance), sine_squared);
  const V half_chord = hn::Sqrt(hn::Max(hn::Sub(seen.radius_squared, across_squared), zero));

  const V to_normal = dot(direction, at.normal);
  const V scattered = scattering(direction, to_normal);
  const V weight = balance_heuristic(chosen.probability, seen, scattered);
  const Mask is_above = hn::And(hn::And(seen.exists, hn::Gt(to_normal, zero)),
                                hn::Gt(scattered, zero));
  return {.exists = hn::And(hn::Gt(chosen.probability, zero), is_above),
          .direction = direction,
          .distance = hn::MulSub(seen.distance, cosine, half_chord),
          .radiance = scaled(read(lights_.radiance), weight),
          .bsdf_weight = weight,
          .slot = read(lights_.slot)};
}

template <typename T, bool kMotion>
auto LightSampler<T, kMotion>::probability(Mask is_light, Bits leaf, const Place& at) const -> V {
  const D d;
  const DU du;
  leaf = hn::IfThenElseZero(hn::RebindMask(du, is_light), leaf);
  V probability = set(1);
  Bits node = word(1);
  for (int level = lights_.levels - 1; level >= 0; --level) {
    const Bits left = hn::Add(node, node);
    Children shares = children(left, at);
    const Bits side = hn::And(hn::ShiftRightSame(leaf, level), word(1));
    const Mask goes_left = hn::RebindMask(d, hn::Eq(side, hn::Zero(du)));
    const V share = hn::IfThenElse(goes_left, shares.share_left, shares.share_right);
    probability = hn::IfThenElseZero(shares.any, hn::Mul(probability, share));
    node = hn::Add(left, side);
  }
  return probability;
}

template <typename T, bool kMotion>
auto LightSampler<T, kMotion>::bsdf_weight(Mask is_light, Bits leaf, const Place& at,
                                           V scattering) const -> V {
  const D d;
  leaf = hn::IfThenElseZero(hn::RebindMask(DU(), is_light), leaf);
  const V chosen = probability(is_light, leaf, at);
  Cone seen = cone(TableReader<D>(leaf, lights_.leaves), at);
  const Mask is_sampled = hn::And(seen.exists, hn::Gt(chosen, hn::Zero(d)));
  return hn::IfThenElse(is_sampled, balance_heuristic(chosen, seen, scattering), set(1));
}

}  // namespace sdlc::render::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
