// The rays that meet a light by way of a sphere that reflects and refracts. Compiled once per
// instruction set, so it has no include guard but Highway's.
// clang-format off
#if defined(SDLC_RENDER_SHADING_SPHERE_SWEEP_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SDLC_RENDER_SHADING_SPHERE_SWEEP_INL_H
#undef SDLC_RENDER_SHADING_SPHERE_SWEEP_INL_H
#else
#define SDLC_RENDER_SHADING_SPHERE_SWEEP_INL_H
#endif
// clang-format on

#include <numbers>

#include <hwy/contrib/math/math-inl.h>
#include <hwy/highway.h>

#include "render/lanes/vector_math-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sdlc::render::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

inline constexpr double kPi = std::numbers::pi, kTurn = 2 * std::numbers::pi;

/// The rays from a point x that meet a light, which is a sphere, by way of another sphere, the
/// caster, with a given number of chords in it: 0 for a reflection outside, 1 for light that passes
/// through, and one more for each reflection inside. Both x and the light are outside of the
/// caster.
///
/// A path stays in one plane with the centre of the caster, and its impact parameter p is the same
/// on all its parts (inside, n times shorter), so one number describes it: the angle of incidence
/// t, p = sin t. Lengths are in radii of the caster. Seen from its centre, the path turns from x to
/// the direction in which it leaves by
///
///     Θ(t) = 2t − asin(p/a) + N (π − 2 asin(p/n))
///
/// with a the distance of x, and N chords. It then passes a point in its plane, at distance b and
/// at the angle τ from x, at the distance |b sin(Θ − τ) − p|. So it meets a light of radius R there
/// if
///
///     Θ − asin((p + R)/b) ≤ τ ≤ Θ − asin((p − R)/b)
///
/// in its plane through the centre of the light, where τ is the angle between x and the light on
/// one side or the other, plus whole turns: the targets. Both bounds first fall with t, and then
/// rise, because cos t / √(c² − p²) decreases for each c ≥ 1; for N = 0 they only rise. So the rays
/// for a target are one interval of t on the falling side, and one on the rising side, which
/// Newton's method finds from the outer ends without overshooting. An R that is small beside b
/// changes the angle at the minimum by little; both sides end at that for R = 0.
template <typename T>
class SphereSweep {
 public:
  using D = Lanes<T>;
  using V = hn::Vec<D>;
  using Mask = hn::Mask<D>;

  SphereSweep() = default;
  /// `a` ≥ 1; `radius`: of the light; `b` > 1 + `radius`. `index` of refraction, at least 1 where
  /// `chords` > 0.
  HWY_INLINE SphereSweep(V a, V b, V radius, V index, V chords)
      : a_(a),
        b_(b),
        a_squared_(hn::Mul(a, a)),
        b_squared_(hn::Mul(b, b)),
        radius_(radius),
        index_(index),
        index_squared_(hn::Mul(index, index)),
        chords_(chords) {}

  /// The targets that are met: on the falling side those from `least` to `start`, on the rising
  /// side those from `least` to `end`.
  struct Range {
    V fold;  ///< the angle of incidence between the sides
    V start, least, end;
  };
  HWY_NOINLINE Range range() const;

  /// A light at `angle`, 0 … π, from x. An axial one is met on all sides at once.
  struct Aim {
    V angle;
    Mask is_axial;
  };
  /// The number of intervals.
  static HWY_INLINE V count(Range range, Aim aim) { return groups(range, aim).total; }

  struct Target {
    V turn;      ///< of the target, τ
    V side;      ///< 1 if the path starts towards the light, −1 if away from it
    Mask rises;  ///< with the angle of incidence
  };
  /// The target of this rank, from 0 to count − 1.
  static HWY_INLINE Target target(Range range, Aim aim, V rank);
  /// The target of a path that has met the light. `sine`: of its angle of incidence.
  HWY_INLINE Target target_of(Range range, Aim aim, V sine, V side) const;

  /// Sines of angles of incidence.
  struct Interval {
    V from, to;
  };
  HWY_NOINLINE Interval interval(Range range, Target target) const;

 private:
  static HWY_INLINE V set(double v) { return hn::Set(D(), static_cast<T>(v)); }
  static HWY_INLINE V sine(V angle) { return sine_of_quarter_turn(hn::Mul(angle, set(1 / kTurn))); }
  static HWY_INLINE V cosine(V angle) {
    return sine_of_quarter_turn(hn::NegMulAdd(angle, set(1 / kTurn), set(0.25)));
  }
  /// c² − p², above 0 where rounding makes it smaller.
  static HWY_INLINE V rest(V squared, V sine) {
    constexpr double kSmallest = sizeof(T) == 4 ? 1e-7 : 1e-15;
    return hn::Max(hn::NegMulAdd(sine, sine, squared), set(kSmallest));
  }
  /// The bound Θ − asin((p + r)/b).
  HWY_INLINE V bound(V angle, V sine, V r) const;
  /// Its derivative.
  HWY_INLINE V slope(V sine, V cosine, V r) const;
  /// Where the bound meets the target, or the end of the side that is nearer to it. `from`: an
  /// angle on that side, farther from the fold.
  HWY_INLINE V meet(Range range, Target target, V r, V from) const;

  // Targets are ±angle + 2πk: `below` is the greatest k below the group's interval.
  struct Group {
    V below, count;
  };
  struct Groups {
    Group down, down_back, up, up_back;
    V total;
  };
  static HWY_INLINE Group group(V low, V high, V angle);
  static HWY_INLINE Groups groups(Range range, Aim aim);

  V a_, b_, a_squared_, b_squared_, radius_, index_, index_squared_, chords_;
};

template <typename T>
auto SphereSweep<T>::bound(V angle, V sine, V r) const -> V {
  const D d;
  const V outside =
      hn::Add(hn::Asin(d, hn::Div(sine, a_)), hn::Asin(d, hn::Div(hn::Add(sine, r), b_)));
  const V chord = hn::NegMulAdd(set(2), hn::Asin(d, hn::Div(sine, index_)), set(kPi));
  return hn::MulAdd(chords_, chord, hn::MulSub(set(2), angle, outside));
}

template <typename T>
auto SphereSweep<T>::slope(V sine, V cosine, V r) const -> V {
  const V square = hn::Max(hn::Mul(cosine, cosine), rest(set(1), set(1)));
  const auto term = [&](V squared, V p)
                        HWY_ATTR { return hn::Sqrt(hn::Div(square, rest(squared, p))); };
  const V outside = hn::Add(term(a_squared_, sine), term(b_squared_, hn::Add(sine, r)));
  const V chords = hn::Mul(hn::Add(chords_, chords_), term(index_squared_, sine));
  return hn::Sub(set(2), hn::Add(outside, chords));
}

template <typename T>
auto SphereSweep<T>::range() const -> Range {
  const V zero = hn::Zero(D()), half = set(kPi / 2);
  // Halving finds the minimum to 2^-13, and the bounds there to 2^-26.
  constexpr int kHalvings = 12;
  V from = zero, width = half;
  for (int i = 0; i < kHalvings; ++i) {
    width = hn::Mul(width, set(0.5));
    const V middle = hn::Add(from, width);
    const Mask falls = hn::Lt(slope(sine(middle), cosine(middle), zero), zero);
    from = hn::IfThenElse(falls, middle, from);
  }
  const Mask falls = hn::Lt(slope(zero, set(1), zero), zero);
  const V fold = hn::IfThenElseZero(falls, hn::MulAdd(width, set(0.5), from));
  const V least = bound(fold, sine(fold), radius_);
  return {.fold = fold,
          .start = hn::IfThenElse(falls, bound(zero, zero, hn::Neg(radius_)), least),
          .least = least,
          .end = bound(half, set(1), hn::Neg(radius_))};
}

template <typename T>
auto SphereSweep<T>::group(V low, V high, V angle) -> Group {
  const auto turns = [&](V of) HWY_ATTR {
    return hn::Floor(hn::Mul(hn::Sub(of, angle), set(1 / kTurn)));
  };
  const V below = turns(low);
  return {below, hn::Max(hn::Sub(turns(high), below), hn::Zero(D()))};
}

template <typename T>
auto SphereSweep<T>::groups(Range range, Aim aim) -> Groups {
  const V back = hn::Neg(aim.angle);
  Groups of{.down = group(range.least, range.start, aim.angle),
            .down_back = group(range.least, range.start, back),
            .up = group(range.least, range.end, aim.angle),
            .up_back = group(range.least, range.end, back),
            .total = hn::Zero(D())};
  of.down_back.count = hn::IfThenZeroElse(aim.is_axial, of.down_back.count);
  of.up_back.count = hn::IfThenZeroElse(aim.is_axial, of.up_back.count);
  of.total =
      hn::Add(hn::Add(of.down.count, of.down_back.count), hn::Add(of.up.count, of.up_back.count));
  return of;
}

template <typename T>
auto SphereSweep<T>::target(Range range, Aim aim, V rank) -> Target {
  const D d;
  const V one = set(1), zero = hn::Zero(d);
  const Groups of = groups(range, aim);
  Mask none = hn::MaskFromVec(zero), is_found = none;
  Target target{zero, one, none};
  const auto visit = [&](Group group, V towards, bool rises) HWY_ATTR {
    const Mask here = hn::AndNot(is_found, hn::Lt(rank, group.count));
    const V turns = hn::Add(hn::Add(group.below, one), rank);
    target.turn = hn::IfThenElse(here, hn::MulAdd(towards, aim.angle, hn::Mul(turns, set(kTurn))),
                                 target.turn);
    target.side = hn::IfThenElse(here, towards, target.side);
    if (rises) target.rises = hn::Or(target.rises, here);
    is_found = hn::Or(is_found, here);
    rank = hn::Sub(rank, group.count);
  };
  visit(of.down, one, false);
  visit(of.down_back, set(-1), false);
  visit(of.up, one, true);
  visit(of.up_back, set(-1), true);
  return target;
}

template <typename T>
auto SphereSweep<T>::target_of(Range range, Aim aim, V sine, V side) const -> Target {
  const V angle = hn::Asin(D(), sine), at = hn::Mul(side, aim.angle);
  const V middle = bound(angle, sine, hn::Zero(D()));
  const V turns = hn::Floor(hn::MulAdd(hn::Sub(middle, at), set(1 / kTurn), set(0.5)));
  return {
      .turn = hn::MulAdd(turns, set(kTurn), at), .side = side, .rises = hn::Ge(angle, range.fold)};
}

template <typename T>
auto SphereSweep<T>::meet(Range range, Target target, V r, V from) const -> V {
  const D d;
  const V zero = hn::Zero(d);
  const V low = hn::IfThenElseZero(target.rises, range.fold);
  const V high = hn::IfThenElse(target.rises, set(kPi / 2), range.fold);
  // A lane rests when it has arrived, so that its result does not depend on the others.
  constexpr int kSteps = sizeof(T) == 4 ? 12 : 20;
  constexpr double kEnough = 1e-3;  // beside the angle that the light fills
  const V small = hn::Mul(hn::Div(radius_, b_), set(kEnough));
  V t = from;
  Mask moves = hn::Eq(zero, zero);
  for (int i = 0; i < kSteps && !hn::AllFalse(d, moves); ++i) {
    const V p = sine(t), rate = slope(p, cosine(t), r);
    const V excess = hn::Sub(bound(t, p, r), target.turn);
    // Beyond the minimum, or so near to it that the step has no sense.
    const Mask is_over = hn::Xor(target.rises, hn::Gt(rate, zero));
    const V next = hn::IfThenElse(is_over, range.fold, hn::Sub(t, hn::Div(excess, rate)));
    const V bounded = hn::Min(hn::Max(next, low), high);
    const Mask rests =
        hn::Or(hn::Lt(hn::Abs(hn::Sub(bounded, t)), small), hn::Eq(bounded, range.fold));
    t = hn::IfThenElse(moves, bounded, t);
    moves = hn::AndNot(rests, moves);
  }
  return t;
}

template <typename T>
auto SphereSweep<T>::interval(Range range, Target target) const -> Interval {
  // The upper bound is met farther out.
  const V end = hn::IfThenElseZero(target.rises, set(kPi / 2));
  const V outer = meet(range, target, radius_, end);
  const V inner = meet(range, target, hn::Neg(radius_), outer);
  return {sine(hn::Min(outer, inner)), sine(hn::Max(outer, inner))};
}

}  // namespace sdlc::render::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
