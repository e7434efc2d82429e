// Paths from one point to another by way of a sphere that reflects and refracts. Compiled once per
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

/// All paths from a point x by way of a sphere to a point y, both outside of the sphere, that have a
/// given number of chords in it: 0 for a reflection outside, 1 for light that passes through, and
/// one more for each reflection inside.
///
/// A path stays in one plane with the centre of the sphere, and its impact parameter p is the same
/// on all its parts (inside, n times shorter), so one number describes it: the angle of incidence t,
/// p = sin t. Lengths are in radii of the sphere. Seen from the centre, the path sweeps the angle
///
///     Θ(t) = 2t − asin(p/a) − asin(p/b) + N (π − 2 asin(p/n))
///
/// with a, b the distances of x and y from the centre, and N chords. A path arrives at y if Θ is the
/// angle between x and y on one side or the other, plus whole turns. For n ≥ 1, Θ is convex: dΘ/dt
/// grows, because cos t / √(c² − p²) decreases for each c ≥ 1. So Θ has one minimum, and each target
/// at most one root on either side of it, which Newton's method finds from the outer end without
/// overshooting.
template <typename T>
class SphereSweep {
 public:
  using D = Lanes<T>;
  using V = hn::Vec<D>;
  using Mask = hn::Mask<D>;

  /// `index` of refraction, at least 1 where `chords` > 0.
  HWY_INLINE SphereSweep(V a, V b, V index, V chords)
      : a_(a),
        b_(b),
        a_squared_(hn::Mul(a, a)),
        b_squared_(hn::Mul(b, b)),
        index_(index),
        index_squared_(hn::Mul(index, index)),
        chords_(chords) {}

  /// The angle of incidence of a path.
  struct Incidence {
    V sine, cosine;
  };
  static HWY_INLINE Incidence incidence(V angle);

  /// The angles that paths sweep: down from `start` to `least`, and up again to `end`.
  struct Range {
    V start, least, end;
  };
  HWY_NOINLINE Range range() const;

  /// The number of paths to a point at `angle`, 0 … π, from x as seen from the centre.
  static HWY_INLINE V count(Range range, V angle) { return groups(range, angle).total; }

  struct Path {
    Incidence at;
    V side;  ///< 1 if the path goes towards y, −1 if it goes the other way round
  };
  /// The path of this rank, from 0 to count − 1.
  HWY_NOINLINE Path find(Range range, V angle, V rank) const;

  /// The solid angle at x of the paths that meet an area at y, perpendicular to them, divided by
  /// that area in squared radii. `sine_angle`: of the angle between x and y.
  HWY_INLINE V density(Incidence at, V sine_angle) const;

 private:
  static HWY_INLINE V set(double v) { return hn::Set(D(), static_cast<T>(v)); }
  /// c² − p², above 0 where rounding makes it smaller.
  static HWY_INLINE V rest(V squared, V sine) {
    constexpr double kSmallest = sizeof(T) == 4 ? 1e-7 : 1e-15;
    return hn::Max(hn::NegMulAdd(sine, sine, squared), set(kSmallest));
  }
  HWY_INLINE V sweep(V angle, V sine) const;
  HWY_INLINE V slope(Incidence at) const;

  // Targets are ±angle + 2πk: `below` is the greatest k below the group's interval.
  struct Group {
    V below, count;
  };
  struct Groups {
    Group down, down_back, up, up_back;
    V total;
  };
  static HWY_INLINE Group group(V low, V high, V angle);
  static HWY_INLINE Groups groups(Range range, V angle);

  V a_, b_, a_squared_, b_squared_, index_, index_squared_, chords_;
};

inline constexpr double kPi = std::numbers::pi, kTurn = 2 * std::numbers::pi;

template <typename T>
auto SphereSweep<T>::incidence(V angle) -> Incidence {
  const V turn = hn::Mul(angle, set(1 / kTurn));
  return {sine_of_quarter_turn(turn), sine_of_quarter_turn(hn::Sub(set(0.25), turn))};
}

template <typename T>
auto SphereSweep<T>::sweep(V angle, V sine) const -> V {
  const D d;
  const V outside =
      hn::Add(hn::Asin(d, hn::Div(sine, a_)), hn::Asin(d, hn::Div(sine, b_)));
  const V chord = hn::NegMulAdd(set(2), hn::Asin(d, hn::Div(sine, index_)), set(kPi));
  return hn::MulAdd(chords_, chord, hn::MulSub(set(2), angle, outside));
}

template <typename T>
auto SphereSweep<T>::slope(Incidence at) const -> V {
  const V square = hn::Max(hn::Mul(at.cosine, at.cosine), rest(set(1), set(1)));
  const auto term = [&](V squared)
                        HWY_ATTR { return hn::Sqrt(hn::Div(square, rest(squared, at.sine))); };
  const V outside = hn::Add(term(a_squared_), term(b_squared_));
  const V chords = hn::Mul(hn::Add(chords_, chords_), term(index_squared_));
  return hn::Sub(set(2), hn::Add(outside, chords));
}

template <typename T>
auto SphereSweep<T>::range() const -> Range {
  const V half = set(kPi / 2);
  // Halving finds the minimum to 2^-13, and Θ there to 2^-26.
  constexpr int kHalvings = 12;
  V from = hn::Zero(D()), width = half;
  for (int i = 0; i < kHalvings; ++i) {
    width = hn::Mul(width, set(0.5));
    const V middle = hn::Add(from, width);
    from = hn::IfThenElse(hn::Lt(slope(incidence(middle)), hn::Zero(D())), middle, from);
  }
  const V start = hn::Mul(chords_, set(kPi));
  const V found = hn::Add(from, hn::Mul(width, set(0.5)));
  const V least = hn::Min(start, sweep(found, incidence(found).sine));
  const Mask falls = hn::Lt(slope({hn::Zero(D()), set(1)}), hn::Zero(D()));
  return {start, hn::IfThenElse(falls, least, start), sweep(half, set(1))};
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
auto SphereSweep<T>::groups(Range range, V angle) -> Groups {
  const V back = hn::Neg(angle);
  Groups of{.down = group(range.least, range.start, angle),
            .down_back = group(range.least, range.start, back),
            .up = group(range.least, range.end, angle),
            .up_back = group(range.least, range.end, back),
            .total = hn::Zero(D())};
  of.total = hn::Add(hn::Add(of.down.count, of.down_back.count),
                     hn::Add(of.up.count, of.up_back.count));
  return of;
}

template <typename T>
auto SphereSweep<T>::find(Range range, V angle, V rank) const -> Path {
  const D d;
  const V one = set(1), zero = hn::Zero(d), half = set(kPi / 2);
  const Groups of = groups(range, angle);
  V target = zero, side = one;
  Mask is_up = hn::MaskFromVec(zero), is_found = is_up;
  const auto visit = [&](Group group, V towards, bool goes_up) HWY_ATTR {
    const Mask here = hn::AndNot(is_found, hn::Lt(rank, group.count));
    const V turns = hn::Add(hn::Add(group.below, one), rank);
    target = hn::IfThenElse(here, hn::MulAdd(towards, angle, hn::Mul(turns, set(kTurn))), target);
    side = hn::IfThenElse(here, towards, side);
    if (goes_up) is_up = hn::Or(is_up, here);
    is_found = hn::Or(is_found, here);
    rank = hn::Sub(rank, group.count);
  };
  visit(of.down, one, false);
  visit(of.down_back, set(-1), false);
  visit(of.up, one, true);
  visit(of.up_back, set(-1), true);

  constexpr int kSteps = sizeof(T) == 4 ? 8 : 12;
  V t = hn::IfThenElse(is_up, half, zero);
  Incidence at = incidence(t);
  for (int i = 0; i < kSteps; ++i) {
    const V step = hn::Div(hn::Sub(sweep(t, at.sine), target), slope(at));
    t = hn::Min(hn::Max(hn::Sub(t, step), zero), half);
    at = incidence(t);
  }
  return {at, side};
}

template <typename T>
auto SphereSweep<T>::density(Incidence at, V sine_angle) const -> V {
  const D d;
  // Near the axis both sines vanish, in the ratio of their slopes.
  constexpr double kNearAxis = sizeof(T) == 4 ? 1e-3 : 1e-6;
  const V size = hn::Abs(slope(at));
  const V ratio = hn::IfThenElse(hn::Lt(at.sine, set(kNearAxis)), hn::Div(set(1), size),
                                 hn::Div(at.sine, sine_angle));
  const V outside = hn::Sqrt(hn::Mul(rest(a_squared_, at.sine), rest(b_squared_, at.sine)));
  const V divisor = hn::Mul(hn::Mul(a_, b_), hn::Mul(outside, size));
  const V density = hn::Div(hn::Mul(ratio, at.cosine), divisor);
  return hn::IfThenElse(hn::Lt(density, set(1e30)), density, set(1e30));
}

}  // namespace sdlc::render::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
