// 3D vectors, 32-bit arithmetic and trigonometry per lane. Compiled once per instruction set, so it
// has no include guard but Highway's.
// clang-format off
#if defined(SDLC_RENDER_LANES_VECTOR_MATH_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SDLC_RENDER_LANES_VECTOR_MATH_INL_H
#undef SDLC_RENDER_LANES_VECTOR_MATH_INL_H
#else
#define SDLC_RENDER_LANES_VECTOR_MATH_INL_H
#endif
// clang-format on

#include <array>
#include <cstdint>

#include <hwy/highway.h>

#include "render/lanes/two_lanes-inl.h"

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
template <typename V>
HWY_INLINE Triple<V> cross(Triple<V> a, Triple<V> b) {
  return {hn::MulSub(a.y, b.z, hn::Mul(a.z, b.y)), hn::MulSub(a.z, b.x, hn::Mul(a.x, b.z)),
          hn::MulSub(a.x, b.y, hn::Mul(a.y, b.x))};
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
/// By component.
template <typename V>
HWY_INLINE Triple<V> product(Triple<V> a, Triple<V> b) {
  return {hn::Mul(a.x, b.x), hn::Mul(a.y, b.y), hn::Mul(a.z, b.z)};
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
/// Negated where `signs` has a sign bit; its other bits are 0.
template <typename V>
HWY_INLINE Triple<V> flipped(Triple<V> a, V signs) {
  return {hn::Xor(a.x, signs), hn::Xor(a.y, signs), hn::Xor(a.z, signs)};
}
template <typename D, typename T>
HWY_INLINE Triple<hn::Vec<D>> spread(D d, const std::array<T, 3>& v) {
  return {hn::Set(d, v[0]), hn::Set(d, v[1]), hn::Set(d, v[2])};
}

#if HWY_TARGET != HWY_SCALAR
/// The halves of a vector of floats.
template <typename D, typename DD = hn::Repartition<double, D>>
HWY_INLINE std::array<hn::Vec<DD>, 2> in_double(D d, hn::Vec<D> v) {
  const hn::Half<D> dh;
  return {hn::PromoteTo(DD(), hn::LowerHalf(dh, v)), hn::PromoteTo(DD(), hn::UpperHalf(dh, v))};
}
template <typename D, typename DD = hn::Repartition<double, D>>
HWY_INLINE hn::Vec<D> in_float(D d, const std::array<hn::Vec<DD>, 2>& halves) {
  const hn::Half<D> dh;
  return hn::Combine(d, hn::DemoteTo(dh, halves[1]), hn::DemoteTo(dh, halves[0]));
}
#endif

/// The square of half the chord of a line in a sphere; negative if it misses. `to_center`: from the
/// line's origin; `closest`: the line parameter nearest to the centre.
template <typename V>
HWY_INLINE V chord_discriminant(Triple<V> to_center, Triple<V> direction, V closest,
                                V radius_squared) {
  const Triple<V> across = minus_scaled(to_center, direction, closest);
  return hn::NegMulAdd(
      across.x, across.x,
      hn::NegMulAdd(across.y, across.y, hn::NegMulAdd(across.z, across.z, radius_squared)));
}

/// The low 32 bits of a product; 64-bit lanes hold numbers below 2^32.
template <typename V>
HWY_INLINE V mul_low_32(V a, V b) {
  const hn::DFromV<V> du;
  if constexpr (sizeof(hn::TFromV<V>) == 4) {
    return hn::Mul(a, b);
  } else if constexpr (kIsPortable) {
    return hn::And(hn::Mul(a, b), hn::Set(du, 0xFFFFFFFFu));
  } else {
    const hn::Repartition<std::uint32_t, decltype(du)> du32;
    return hn::And(hn::MulEven(hn::BitCast(du32, a), hn::BitCast(du32, b)),
                   hn::Set(du, 0xFFFFFFFFu));
  }
}

template <typename V>
HWY_INLINE V mul_low_32(V a, std::uint32_t factor) {
  return mul_low_32(a, hn::Set(hn::DFromV<V>(), factor));
}

/// The product of the low halves of 64-bit lanes.
template <typename V>
HWY_INLINE V mul_even_32(V a, V b) {
  if constexpr (kIsPortable) {
    return hn::Mul(a, b);  // both are below 2^31
  } else {
    const hn::Repartition<std::int32_t, hn::DFromV<V>> di32;
    return hn::MulEven(hn::BitCast(di32, a), hn::BitCast(di32, b));
  }
}

/// The low 32 bits of a sum.
template <typename V>
HWY_INLINE V add_low_32(V a, V b) {
  const hn::DFromV<V> du;
  if constexpr (sizeof(hn::TFromV<V>) == 4) return hn::Add(a, b);
  return hn::And(hn::Add(a, b), hn::Set(du, 0xFFFFFFFFu));
}

/// Reverses the order of the low 32 bits.
template <typename V>
HWY_INLINE V reverse_lane_bits(V x) {
  const hn::DFromV<V> du;
  if constexpr (kIsPortable) {
    const auto swap = [&](V v, int bits, std::uint32_t lower) HWY_ATTR {
      const V mask = hn::Set(du, lower);
      const V up = hn::And(v, mask), down = hn::And(hn::ShiftRightSame(v, bits), mask);
      return hn::Or(hn::ShiftLeftSame(up, bits), down);
    };
    return swap(
        swap(swap(swap(swap(x, 1, 0x55555555), 2, 0x33333333), 4, 0x0F0F0F0F), 8, 0x00FF00FF), 16,
        0xFFFF);
  } else {
    // The half bytes by a table, then the bytes.
    const hn::Repartition<std::uint8_t, decltype(du)> bytes;
    // Tables of reversed half bytes; the lower half of a byte becomes the upper one and vice versa.
    alignas(16) static constexpr std::uint8_t kToUpper[16]{0x00, 0x80, 0x40, 0xC0, 0x20, 0xA0,
                                                           0x60, 0xE0, 0x10, 0x90, 0x50, 0xD0,
                                                           0x30, 0xB0, 0x70, 0xF0};
    alignas(16) static constexpr std::uint8_t kToLower[16]{0x0, 0x8, 0x4, 0xC, 0x2, 0xA, 0x6, 0xE,
                                                           0x1, 0x9, 0x5, 0xD, 0x3, 0xB, 0x7, 0xF};
    // The upper half of a 64-bit lane is 0 and stays 0.
    alignas(16) static constexpr std::uint8_t kOrder[16]{3,  2,  1, 0, 7,  6,  5,  4,
                                                         11, 10, 9, 8, 15, 14, 13, 12};
    const auto half = hn::Set(bytes, 0x0F);
    const auto in_bytes = hn::BitCast(bytes, x);
    const auto upper =
        hn::TableLookupBytes(hn::LoadDup128(bytes, kToUpper), hn::And(in_bytes, half));
    const auto shifted = hn::BitCast(bytes, hn::ShiftRight<4>(x));
    const auto lower =
        hn::TableLookupBytes(hn::LoadDup128(bytes, kToLower), hn::And(shifted, half));
    return hn::BitCast(du,
                       hn::TableLookupBytes(hn::Or(upper, lower), hn::LoadDup128(bytes, kOrder)));
  }
}

/// sin(2π x) for |x| ≤ 1/4.
template <typename V>
HWY_INLINE V sine_of_quarter_turn(V x) {
  const hn::DFromV<V> d;
  using T = hn::TFromV<V>;
  const V y = hn::Mul(x, x);
  V p;
  if constexpr (sizeof(T) == 4) {
    // Here and below: minimax polynomials for the relative error, by Remez' algorithm: 5.3e-9, and
    // 1.4e-16 in double.
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

/// The point at `turn`, from 0 to 1 turn, on the circle around the origin; the turn starts at −x.
template <typename V>
HWY_INLINE void point_on_circle(V turn, V radius, V& x, V& y) {
  const hn::DFromV<V> d;
  const V half = hn::Set(d, hn::TFromV<V>{0.5}), quarter = hn::Set(d, hn::TFromV<V>{0.25});
  const V u = hn::Sub(turn, half);  // −1/2 … 1/2
  const V size = hn::Abs(u);
  // The sine at 1/2 − u equals that at u.
  const V folded = hn::IfThenElse(hn::Gt(size, quarter), hn::Sub(hn::CopySign(half, u), u), u);
  x = hn::Mul(radius, sine_of_quarter_turn(hn::Sub(quarter, size)));
  y = hn::Mul(radius, sine_of_quarter_turn(folded));
}

/// The direction at an angle to `axis`, given by its cosine and the square of its sine, and at
/// `turn` around it.
template <typename V>
HWY_INLINE Triple<V> around(Triple<V> axis, V cosine, V sine_squared, V turn) {
  const hn::DFromV<V> d;
  const V one = hn::Set(d, hn::TFromV<V>{1});
  // Two perpendicular directions by Duff et al., "Building an orthonormal basis, revisited", 2017.
  const Triple<V> z = axis;
  const V sign = hn::CopySign(one, z.z);
  const V a = hn::Neg(hn::Div(one, hn::Add(sign, z.z)));
  const V b = hn::Mul(hn::Mul(z.x, z.y), a);
  const Triple<V> x{hn::MulAdd(hn::Mul(sign, z.x), hn::Mul(z.x, a), one), hn::Mul(sign, b),
                    hn::Neg(hn::Mul(sign, z.x))};
  const Triple<V> y{b, hn::MulAdd(hn::Mul(z.y, z.y), a, sign), hn::Neg(z.y)};
  V along_x, along_y;
  point_on_circle(turn, hn::Sqrt(sine_squared), along_x, along_y);
  return plus_scaled(plus_scaled(scaled(z, cosine), x, along_x), y, along_y);
}

/// ∛x for x in [0, 1]; 0 below 2^-126.
template <typename V>
HWY_INLINE V cube_root(V x) {
  const hn::DFromV<V> d;
  const hn::RebindToSigned<decltype(d)> di;
  using T = hn::TFromV<V>;
  // A third of the bits as an integer approximates a third of the logarithm plus a constant, to 4 %
  // (Kahan's method, as in FreeBSD's cbrt). 2^-32 is the smallest number, so that float can hold a
  // third.
  V y;
  if constexpr (sizeof(T) == 4) {
    const V bits = hn::ConvertTo(d, hn::BitCast(di, x));
    const auto third = hn::ConvertTo(di, hn::Mul(bits, hn::Set(d, 1 / 3.0f)));
    y = hn::BitCast(d, hn::Add(third, hn::Set(di, 709958130)));
  } else {
    const auto high = hn::ShiftRight<32>(hn::BitCast(di, x));
    // high / 3 by multiplication; exact enough, because high is below 2^31.
    const auto third = hn::ShiftRight<32>(mul_even_32(high, hn::Set(di, 0x55555556)));
    y = hn::BitCast(d, hn::ShiftLeft<32>(hn::Add(third, hn::Set(di, 715094163))));
  }
  // Halley's iteration: each step cubes the error, 4e-2 to 4e-5 to 1e-13 and below rounding.
  const int steps = sizeof(T) == 4 ? 2 : 3;
  for (int i = 0; i < steps; ++i) {
    const V cube = hn::Mul(hn::Mul(y, y), y);
    y = hn::Mul(y, hn::Div(hn::Add(cube, hn::Add(x, x)), hn::Add(hn::Add(cube, cube), x)));
  }
  return hn::IfThenElseZero(hn::Gt(x, hn::Zero(d)), y);
}

/// The share of unpolarised light reflected, by Fresnel's equations, given the cosines on both
/// sides.
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
