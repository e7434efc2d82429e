// Vectors of three, random numbers, sines: what a lane needs, compiled once for each instruction
// set. No include guard but Highway's.
// clang-format off
#if defined(SDLC_RENDER_WIDE_VECTOR_MATH_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SDLC_RENDER_WIDE_VECTOR_MATH_INL_H
#undef SDLC_RENDER_WIDE_VECTOR_MATH_INL_H
#else
#define SDLC_RENDER_WIDE_VECTOR_MATH_INL_H
#endif
// clang-format on

#include <array>
#include <cstdint>

#include <hwy/highway.h>

#include "render/sampler/sampler.hpp"

HWY_BEFORE_NAMESPACE();
namespace sdlc::render::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

template <typename V>
struct Triple {
  V x, y, z;
};

template <typename V>
HWY_INLINE V dot(Triple<V> a, Triple<V> b) {
  return hn::MulAdd(a.x, b.x, hn::MulAdd(a.y, b.y, hn::Mul(a.z, b.z)));
}
/// a + b · s
template <typename V>
HWY_INLINE Triple<V> plus_scaled(Triple<V> a, Triple<V> b, V s) {
  return {hn::MulAdd(b.x, s, a.x), hn::MulAdd(b.y, s, a.y), hn::MulAdd(b.z, s, a.z)};
}
/// a − b · s
template <typename V>
HWY_INLINE Triple<V> minus_scaled(Triple<V> a, Triple<V> b, V s) {
  return {hn::NegMulAdd(b.x, s, a.x), hn::NegMulAdd(b.y, s, a.y), hn::NegMulAdd(b.z, s, a.z)};
}
template <typename V>
HWY_INLINE Triple<V> scaled(Triple<V> a, V s) {
  return {hn::Mul(a.x, s), hn::Mul(a.y, s), hn::Mul(a.z, s)};
}
template <typename V>
HWY_INLINE Triple<V> minus(Triple<V> a, Triple<V> b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
template <typename M, typename V>
HWY_INLINE Triple<V> choose(M mask, Triple<V> yes, Triple<V> no) {
  return {hn::IfThenElse(mask, yes.x, no.x), hn::IfThenElse(mask, yes.y, no.y),
          hn::IfThenElse(mask, yes.z, no.z)};
}
template <typename D, typename T>
HWY_INLINE Triple<hn::Vec<D>> spread(D d, const std::array<T, 3>& v) {
  return {hn::Set(d, v[0]), hn::Set(d, v[1]), hn::Set(d, v[2])};
}

/// Half the chord that a sphere cuts out of a line, squared; negative where it misses. `to_center`:
/// from the line's origin; `middle`: where the line comes nearest to the centre.
template <typename V>
HWY_INLINE V chord_discriminant(Triple<V> to_center, Triple<V> direction, V middle,
                                V radius_squared) {
  const Triple<V> across = minus_scaled(to_center, direction, middle);
  return hn::NegMulAdd(
      across.x, across.x,
      hn::NegMulAdd(across.y, across.y, hn::NegMulAdd(across.z, across.z, radius_squared)));
}

// --- random numbers: render/sampler/sampler.hpp in every lane ---

/// The low 32 bits of a product; lanes of 64 bits hold numbers below 2^32.
HWY_INLINE auto mul_low_32(auto a, std::uint32_t factor) {
  const hn::DFromV<decltype(a)> du;
  if constexpr (sizeof(hn::TFromD<decltype(du)>) == 4) {
    return hn::Mul(a, hn::Set(du, factor));
  } else {
    const hn::Repartition<std::uint32_t, decltype(du)> du32;
    return hn::And(hn::MulEven(hn::BitCast(du32, a), hn::BitCast(du32, hn::Set(du, factor))),
                   hn::Set(du, 0xFFFFFFFFu));
  }
}

/// The low 32 bits of a sum.
template <typename V>
HWY_INLINE V add_low_32(V a, V b) {
  const hn::DFromV<V> du;
  if constexpr (sizeof(hn::TFromV<V>) == 4) return hn::Add(a, b);
  return hn::And(hn::Add(a, b), hn::Set(du, 0xFFFFFFFFu));
}

template <typename V>
HWY_INLINE V mix_lanes(V x, V key) {
  x = add_low_32(mul_low_32(hn::Xor(x, hn::ShiftRight<16>(x)), 0x7FEB352D), key);
  return mul_low_32(hn::Xor(x, hn::ShiftRight<15>(x)), 0x846CA68B);
}

/// 32 bits as a number in [0, 1): 24 of them in float, all in double.
template <typename D, typename V>
HWY_INLINE hn::Vec<D> uniform_from_bits(D d, V bits) {
  if constexpr (sizeof(hn::TFromD<D>) == 4) {
    const hn::RebindToSigned<D> di;
    return hn::Mul(hn::ConvertTo(d, hn::BitCast(di, hn::ShiftRight<8>(bits))),
                   hn::Set(d, 0x1p-24f));
  } else {
    const hn::RebindToUnsigned<D> du;
    // The bits become the low ones of the significand of a number from 2^52 on.
    const auto magic = hn::Set(d, 0x1p52);
    const auto number = hn::BitCast(d, hn::Or(bits, hn::BitCast(du, magic)));
    return hn::Mul(hn::Sub(number, magic), hn::Set(d, 0x1p-32));
  }
}

/// The numbers of one block of dimensions.
template <typename D>
class LaneSampler {
 public:
  using Bits = hn::Vec<hn::RebindToUnsigned<D>>;

  /// `start`: PathSampler's, plus the increments up to the block.
  HWY_INLINE LaneSampler(Bits start, Bits mixer) : start_(start), mixer_(mixer) {}

  HWY_INLINE hn::Vec<D> uniform(std::uint32_t dimension) const {
    const hn::RebindToUnsigned<D> du;
    const auto offset = hn::Set(du, (dimension + 1) * PathSampler::kIncrement);
    return uniform_from_bits(D(), mix_lanes(add_low_32(start_, offset), mixer_));
  }

 private:
  Bits start_, mixer_;
};

// --- sine and cosine ---

/// sin(2π x) for |x| ≤ 1/4.
template <typename V>
HWY_INLINE V sine_of_quarter_turn(V x) {
  const hn::DFromV<V> d;
  using T = hn::TFromV<V>;
  const V y = hn::Mul(x, x);
  V p;
  if constexpr (sizeof(T) == 4) {
    // Here and below: least maximum relative error among polynomials of the degree, by Remez'
    // exchange: 5.3e-9, and 1.4e-16 in double.
    p = hn::Set(d, 39.7109184f);
    p = hn::MulAdd(p, y, hn::Set(d, -76.5749893f));
    p = hn::MulAdd(p, y, hn::Set(d, 81.6022339f));
    p = hn::MulAdd(p, y, hn::Set(d, -41.3416786f));
    p = hn::MulAdd(p, y, hn::Set(d, 6.28318548f));
  } else {
    p = hn::Set(d, -0.69215694788291671);
    p = hn::MulAdd(p, y, hn::Set(d, 3.8172886438194293));
    p = hn::MulAdd(p, y, hn::Set(d, -15.094499475226721));
    p = hn::MulAdd(p, y, hn::Set(d, 42.058689667371439));
    p = hn::MulAdd(p, y, hn::Set(d, -76.705859683291166));
    p = hn::MulAdd(p, y, hn::Set(d, 81.605249275512847));
    p = hn::MulAdd(p, y, hn::Set(d, -41.341702240398021));
    p = hn::MulAdd(p, y, hn::Set(d, 6.2831853071795853));
  }
  return hn::Mul(x, p);
}

/// The point at `turn`, from 0 to 1 turn, of the circle around the origin; the turn begins at −x.
template <typename V>
HWY_INLINE void point_on_circle(V turn, V radius, V& x, V& y) {
  const hn::DFromV<V> d;
  const V half = hn::Set(d, hn::TFromV<V>{0.5}), quarter = hn::Set(d, hn::TFromV<V>{0.25});
  const V u = hn::Sub(turn, half);  // −1/2 … 1/2
  const V size = hn::Abs(u);
  // The sine at 1/2 − u is the one at u.
  const V folded = hn::IfThenElse(hn::Gt(size, quarter), hn::Sub(hn::CopySign(half, u), u), u);
  x = hn::Mul(radius, sine_of_quarter_turn(hn::Sub(quarter, size)));
  y = hn::Mul(radius, sine_of_quarter_turn(folded));
}

/// Share of unpolarised light reflected by Fresnel's equations, with the cosines on both sides.
template <typename V>
HWY_INLINE V fresnel_exact_lanes(V incident, V beyond, V eta) {
  const hn::DFromV<V> d;
  using T = hn::TFromV<V>;
  const V across = hn::Div(hn::NegMulAdd(eta, incident, beyond), hn::MulAdd(eta, incident, beyond));
  const V along = hn::Div(hn::NegMulAdd(eta, beyond, incident), hn::MulAdd(eta, beyond, incident));
  const V share = hn::Mul(hn::Set(d, T{0.5}), hn::MulAdd(across, across, hn::Mul(along, along)));
  const auto is_grazing = hn::Eq(hn::Add(incident, beyond), hn::Zero(d));  // on both sides
  return hn::IfThenElse(is_grazing, hn::Set(d, T{1}), share);
}

}  // namespace sdlc::render::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
