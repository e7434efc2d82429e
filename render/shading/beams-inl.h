// The directions in which rays meet a light by way of a sphere. Compiled once per instruction set,
// so it has no include guard but Highway's.
// clang-format off
#if defined(SDLC_RENDER_SHADING_BEAMS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SDLC_RENDER_SHADING_BEAMS_INL_H
#undef SDLC_RENDER_SHADING_BEAMS_INL_H
#else
#define SDLC_RENDER_SHADING_BEAMS_INL_H
#endif
// clang-format on

#include <cstdint>

#include <hwy/contrib/math/math-inl.h>
#include <hwy/highway.h>

#include "render/lanes/vector_math-inl.h"
#include "render/shading/sphere_sweep-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sdlc::render::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Paths with more chords in a caster, of which little light is left, are left to scattering.
inline constexpr std::uint32_t kMaxChords = 6;

/// The directions at a point x in which rays meet a light, which is a sphere, by way of another
/// one, the caster, as a few beams: each an interval of angles to the axis, which leads from x to
/// the centre of the caster, times an interval of angles around it. Rays that leave between the
/// beams miss the light; of those in a beam, most meet it.
template <typename T>
class Beams {
 public:
  using D = Lanes<T>;
  using V = hn::Vec<D>;
  using Mask = hn::Mask<D>;
  using Sweep = SphereSweep<T>;

  struct Ball {
    Triple<V> center;
    V radius;
  };
  /// `index` of refraction of the caster and `chords` as for SphereSweep. There are no beams where
  /// x or part of the light is inside the caster, and where the light is so small that directions,
  /// which are rounded, can hardly meet it.
  HWY_NOINLINE Beams(Triple<V> x, const Ball& caster, const Ball& light, V index, V chords);

  HWY_INLINE Mask exist() const { return hn::And(is_known_, hn::Gt(count_, set(0.5))); }
  /// Whether they would exist if rays could meet the light.
  HWY_INLINE Mask is_known() const { return is_known_; }
  HWY_INLINE V count() const { return count_; }

  struct Beam {
    V side;          ///< 1 if it starts towards the light, −1 if away from it
    V sine, cosine;  ///< of the angle to the axis, where that is smallest
    V sine_at_end;   ///< where it is largest
    V height;        ///< of the interval, measured by the cosine
    V solid_angle;   ///< 0: it is too narrow for numbers of this type
  };
  /// The beam of this rank, from 0 to count() − 1.
  HWY_INLINE Beam beam(V rank) const { return beam(Sweep::target(range_, aim_, rank)); }
  /// Uniform in solid angle for random numbers from 0 to 1.
  HWY_INLINE Triple<V> direction(const Beam& beam, V height, V turn) const;

  struct Found {
    Beam beam;
    Mask contains;
  };
  /// The beam of a direction in which a ray has met the light.
  HWY_INLINE Found find(Triple<V> direction) const;

 private:
  static HWY_INLINE V set(double v) { return hn::Set(D(), static_cast<T>(v)); }
  static HWY_INLINE V length(Triple<V> v) { return hn::Sqrt(dot(v, v)); }
  HWY_INLINE Beam beam(typename Sweep::Target target) const;

  Triple<V> axis_, across_;           // of length 1; the second is perpendicular, towards the light
  V distance_;                        // from x to the centre, in radii of the caster
  V half_width_, half_width_cosine_;  // of the interval around the axis
  typename Sweep::Aim aim_;
  typename Sweep::Range range_;
  Sweep sweep_;
  V count_;
  Mask is_known_;
};

template <typename T>
Beams<T>::Beams(Triple<V> x, const Ball& caster, const Ball& light, V index, V chords) {
  const D d;
  const V zero = hn::Zero(d), one = set(1), quarter = set(kPi / 4);
  const V scale = hn::Div(one, caster.radius);
  const Triple<V> to_x = scaled(minus(x, caster.center), scale);
  const Triple<V> to_light = scaled(minus(light.center, caster.center), scale);
  const V a = length(to_x), b = length(to_light), radius = hn::Mul(light.radius, scale);
  const Triple<V> at_x = scaled(to_x, hn::Div(one, a));
  const Triple<V> at_light = scaled(to_light, hn::Div(one, b));
  const Triple<V> difference = minus(at_x, at_light), sum = plus_scaled(at_x, at_light, one);
  // Accurate near 0 and π, too (Kahan).
  const V apart = length(difference), together = length(sum);
  const Mask is_near = hn::Lt(apart, together);
  const V ratio =
      hn::Div(hn::IfThenElse(is_near, apart, together), hn::IfThenElse(is_near, together, apart));
  const V half = hn::Atan(d, ratio);
  const V half_angle = hn::IfThenElse(is_near, half, hn::Sub(hn::Add(quarter, quarter), half));

  // A light on the axis is met from all sides. It is replaced by one around the axis, in which it
  // lies.
  const Triple<V> across = minus_scaled(at_light, at_x, dot(at_x, at_light));
  const V sine = length(across), off_axis = hn::Mul(b, sine);
  const Mask is_axial = hn::Le(off_axis, radius);
  const V on_axis = hn::IfThenElseZero(hn::Not(is_near), set(kPi));
  const V angle = hn::IfThenElse(is_axial, on_axis, hn::Add(half_angle, half_angle));
  const V reach = hn::IfThenElse(is_axial, hn::Add(radius, off_axis), radius);
  const V width = hn::Min(hn::Div(radius, hn::IfThenElse(is_axial, one, off_axis)), one);
  const V width_cosine = hn::Sqrt(hn::NegMulAdd(width, width, one));
  axis_ = scaled(at_x, set(-1));
  across_ = choose(is_axial, around(axis_, zero, one, zero), scaled(across, hn::Div(one, sine)));
  half_width_ = hn::IfThenElse(is_axial, set(kPi), hn::Asin(d, width));
  half_width_cosine_ = hn::IfThenElse(is_axial, set(-1), width_cosine);
  aim_ = {angle, is_axial};

  // Directions are rounded to about 2^-24 and 2^-53.
  constexpr double kSmallest = sizeof(T) == 4 ? 1e-5 : 1e-13;
  is_known_ = hn::And(hn::Ge(a, one), hn::Gt(b, hn::Add(one, reach)));
  is_known_ = hn::And(is_known_, hn::Gt(radius, hn::Mul(b, set(kSmallest))));
  const auto known = [&](V value, double otherwise)
                         HWY_ATTR { return hn::IfThenElse(is_known_, value, set(otherwise)); };
  distance_ = known(a, 2);
  sweep_ = Sweep(distance_, known(b, 2), known(reach, 0.5), index, chords);
  range_ = sweep_.range();
  count_ = Sweep::count(range_, aim_);
}

template <typename T>
auto Beams<T>::beam(typename Sweep::Target target) const -> Beam {
  const V one = set(1), zero = hn::Zero(D());
  const auto incidence = sweep_.interval(range_, target);
  const V from = hn::Div(incidence.from, distance_), to = hn::Div(incidence.to, distance_);
  const auto cosine_of = [&](V sine) HWY_ATTR {
    return hn::Sqrt(hn::Max(hn::NegMulAdd(sine, sine, one), zero));
  };
  const V cosine = cosine_of(from), sum = hn::Add(cosine, cosine_of(to));
  const V squares = hn::Mul(hn::Sub(to, from), hn::Add(to, from));
  const V height = hn::IfThenElseZero(hn::Gt(sum, zero), hn::Div(squares, sum));
  return {.side = target.side,
          .sine = from,
          .cosine = cosine,
          .sine_at_end = to,
          .height = height,
          .solid_angle = hn::Mul(hn::Add(half_width_, half_width_), height)};
}

template <typename T>
auto Beams<T>::direction(const Beam& beam, V height, V turn) const -> Triple<V> {
  const V one = set(1);
  const V below = hn::Mul(height, beam.height);
  const V twice = hn::Sub(hn::Add(beam.cosine, beam.cosine), below);
  const V squared = hn::MulAdd(below, twice, hn::Mul(beam.sine, beam.sine));
  const V angle = hn::Mul(hn::MulSub(set(2), turn, one), half_width_);
  V along, beside;
  point_on_circle(hn::MulAdd(angle, set(1 / kTurn), set(0.5)),
                  hn::Mul(hn::Sqrt(squared), beam.side), along, beside);
  Triple<V> direction = scaled(axis_, hn::Sub(beam.cosine, below));
  direction = plus_scaled(plus_scaled(direction, across_, along), cross(axis_, across_), beside);
  return scaled(direction, hn::Div(one, length(direction)));
}

template <typename T>
auto Beams<T>::find(Triple<V> direction) const -> Found {
  const V one = set(1);
  const Triple<V> beside = minus_scaled(direction, axis_, dot(direction, axis_));
  const V towards = dot(beside, across_), sine = length(beside);
  const Mask is_away = hn::AndNot(aim_.is_axial, hn::Lt(towards, hn::Zero(D())));
  const V side = hn::IfThenElse(is_away, set(-1), one);
  const V impact = hn::Min(hn::Mul(sine, distance_), one);
  const Beam beam = this->beam(sweep_.target_of(range_, aim_, impact, side));
  const Mask is_beside = hn::Ge(hn::Mul(towards, side), hn::Mul(sine, half_width_cosine_));
  const Mask is_within = hn::And(hn::Ge(sine, beam.sine), hn::Le(sine, beam.sine_at_end));
  const Mask contains = hn::And(is_beside, is_within);
  return {beam, hn::And(contains, hn::Gt(beam.solid_angle, hn::Zero(D())))};
}

}  // namespace sdlc::render::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
