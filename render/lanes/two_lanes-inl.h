// Vectors of two numbers for the portable backend: the operations of Highway that the kernels use,
// by the vector extension of the compilers, which translate them for every machine. Highway's own
// emulation of 128 bits is miscompiled by g++ before 12.3 (GCC bug 106322).
// clang-format off
#if defined(SDLC_RENDER_LANES_TWO_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SDLC_RENDER_LANES_TWO_LANES_INL_H
#undef SDLC_RENDER_LANES_TWO_LANES_INL_H
#else
#define SDLC_RENDER_LANES_TWO_LANES_INL_H
#endif
// clang-format on

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include <hwy/highway.h>

#if HWY_TARGET == HWY_SCALAR
HWY_BEFORE_NAMESPACE();
namespace hwy::HWY_NAMESPACE {  // where kernels look for operations

template <typename T>
using TwoLanes = Simd<T, 2, 0>;
template <typename T>
struct Vec2 {
  typedef T Raw __attribute__((vector_size(2 * sizeof(T))));  // NOLINT: `using` ignores the size
  Raw raw;
  using PrivateT = T;  // for DFromV
  static constexpr std::size_t kPrivateN = 2;
};
/// Each lane is 0 or -1.
template <typename T>
struct Mask2 {
  using Raw = typename Vec2<MakeSigned<T>>::Raw;
  Raw raw;
};

template <typename T>
HWY_INLINE typename Mask2<T>::Raw bits_of_lanes(Vec2<T> v) {
  return reinterpret_cast<typename Mask2<T>::Raw>(v.raw);
}
template <typename T>
HWY_INLINE Vec2<T> from_bits(typename Mask2<T>::Raw bits) {
  return {reinterpret_cast<typename Vec2<T>::Raw>(bits)};
}

template <typename T>
HWY_INLINE Vec2<T> Zero(TwoLanes<T> /*d*/) {
  return {typename Vec2<T>::Raw{}};
}
template <typename T>
HWY_INLINE Vec2<T> Set(TwoLanes<T> /*d*/, std::type_identity_t<T> v) {
  return {typename Vec2<T>::Raw{v, v}};
}
template <typename T, typename First>
HWY_INLINE Vec2<T> Iota(TwoLanes<T> /*d*/, First first) {
  const T from = static_cast<T>(first);
  return {typename Vec2<T>::Raw{from, from + 1}};
}
template <typename T>
HWY_INLINE Vec2<T> Load(TwoLanes<T> /*d*/, const T* from) {
  Vec2<T> v;
  std::memcpy(&v.raw, from, sizeof v.raw);
  return v;
}
template <typename T>
HWY_INLINE void Store(Vec2<T> v, TwoLanes<T> /*d*/, T* to) {
  std::memcpy(to, &v.raw, sizeof v.raw);
}
template <typename T, typename Index>
HWY_INLINE Vec2<T> GatherIndex(TwoLanes<T> /*d*/, const T* base, Vec2<Index> index) {
  return {typename Vec2<T>::Raw{base[index.raw[0]], base[index.raw[1]]}};
}
template <typename T>
HWY_INLINE Vec2<T> Floor(Vec2<T> v) {
  return {typename Vec2<T>::Raw{std::floor(v.raw[0]), std::floor(v.raw[1])}};
}
template <typename T>
HWY_INLINE Vec2<T> Asin(TwoLanes<T> /*d*/, Vec2<T> v) {
  return {typename Vec2<T>::Raw{std::asin(v.raw[0]), std::asin(v.raw[1])}};
}
template <typename T>
HWY_INLINE Vec2<T> Atan(TwoLanes<T> /*d*/, Vec2<T> v) {
  return {typename Vec2<T>::Raw{std::atan(v.raw[0]), std::atan(v.raw[1])}};
}
template <typename T>
HWY_INLINE T GetLane(Vec2<T> v) {
  return v.raw[0];
}
template <typename T>
HWY_INLINE Vec2<T> SumOfLanes(TwoLanes<T> d, Vec2<T> v) {
  return Set(d, v.raw[0] + v.raw[1]);
}

#define SDLC_TWO_LANES(name, parameters, result) \
  template <typename T>                          \
  HWY_INLINE Vec2<T> name parameters {           \
    return {result};                             \
  }
SDLC_TWO_LANES(Add, (Vec2<T> a, Vec2<T> b), a.raw + b.raw)
SDLC_TWO_LANES(Sub, (Vec2<T> a, Vec2<T> b), a.raw - b.raw)
SDLC_TWO_LANES(Mul, (Vec2<T> a, Vec2<T> b), a.raw* b.raw)
SDLC_TWO_LANES(Div, (Vec2<T> a, Vec2<T> b), a.raw / b.raw)
SDLC_TWO_LANES(MulAdd, (Vec2<T> a, Vec2<T> b, Vec2<T> c), a.raw* b.raw + c.raw)
SDLC_TWO_LANES(MulSub, (Vec2<T> a, Vec2<T> b, Vec2<T> c), a.raw* b.raw - c.raw)
SDLC_TWO_LANES(NegMulAdd, (Vec2<T> a, Vec2<T> b, Vec2<T> c), c.raw - a.raw * b.raw)
SDLC_TWO_LANES(Neg, (Vec2<T> v), -v.raw)
SDLC_TWO_LANES(Max, (Vec2<T> a, Vec2<T> b), a.raw > b.raw ? a.raw : b.raw)
SDLC_TWO_LANES(Min, (Vec2<T> a, Vec2<T> b), a.raw < b.raw ? a.raw : b.raw)
SDLC_TWO_LANES(ShiftLeftSame, (Vec2<T> v, int bits), v.raw << bits)
SDLC_TWO_LANES(ShiftRightSame, (Vec2<T> v, int bits), v.raw >> bits)
SDLC_TWO_LANES(IfThenElse, (Mask2<T> m, Vec2<T> yes, Vec2<T> no), m.raw ? yes.raw : no.raw)
#undef SDLC_TWO_LANES
template <typename T>
HWY_INLINE Vec2<T> Sqrt(Vec2<T> v) {
  return {typename Vec2<T>::Raw{std::sqrt(v.raw[0]), std::sqrt(v.raw[1])}};
}
template <int kBits, typename T>
HWY_INLINE Vec2<T> ShiftRight(Vec2<T> v) {
  return {v.raw >> kBits};
}
template <int kBits, typename T>
HWY_INLINE Vec2<T> ShiftLeft(Vec2<T> v) {
  return {v.raw << kBits};
}

template <typename T>
HWY_INLINE Vec2<T> And(Vec2<T> a, Vec2<T> b) {
  return from_bits<T>(bits_of_lanes(a) & bits_of_lanes(b));
}
template <typename T>
HWY_INLINE Vec2<T> AndNot(Vec2<T> a, Vec2<T> b) {
  return from_bits<T>(~bits_of_lanes(a) & bits_of_lanes(b));
}
template <typename T>
HWY_INLINE Vec2<T> Or(Vec2<T> a, Vec2<T> b) {
  return from_bits<T>(bits_of_lanes(a) | bits_of_lanes(b));
}
template <typename T>
HWY_INLINE Vec2<T> Xor(Vec2<T> a, Vec2<T> b) {
  return from_bits<T>(bits_of_lanes(a) ^ bits_of_lanes(b));
}
template <typename T>
HWY_INLINE Vec2<T> SignBit(TwoLanes<T> d) {
  return Set(d, T{-0.0});
}
template <typename T>
HWY_INLINE Vec2<T> Abs(Vec2<T> v) {
  return AndNot(SignBit(TwoLanes<T>()), v);
}
template <typename T>
HWY_INLINE Vec2<T> CopySign(Vec2<T> size, Vec2<T> sign) {
  return Or(Abs(size), And(SignBit(TwoLanes<T>()), sign));
}
template <typename T>
HWY_INLINE Vec2<T> IfThenElseZero(Mask2<T> m, Vec2<T> yes) {
  return from_bits<T>(m.raw & bits_of_lanes(yes));
}
template <typename T>
HWY_INLINE Vec2<T> IfThenZeroElse(Mask2<T> m, Vec2<T> no) {
  return from_bits<T>(~m.raw & bits_of_lanes(no));
}

template <typename To, typename From>
HWY_INLINE Vec2<To> BitCast(TwoLanes<To> /*d*/, Vec2<From> v) {
  return {reinterpret_cast<typename Vec2<To>::Raw>(v.raw)};
}
template <typename To, typename From>
HWY_INLINE Vec2<To> PromoteTo(TwoLanes<To> /*d*/, Vec2<From> v) {
  return {__builtin_convertvector(v.raw, typename Vec2<To>::Raw)};
}
template <typename To, typename From>
HWY_INLINE Vec2<To> TruncateTo(TwoLanes<To> /*d*/, Vec2<From> v) {
  return {__builtin_convertvector(v.raw, typename Vec2<To>::Raw)};
}

#define SDLC_TWO_LANES(name, operation)            \
  template <typename T>                            \
  HWY_INLINE Mask2<T> name(Vec2<T> a, Vec2<T> b) { \
    return {a.raw operation b.raw};                \
  }
SDLC_TWO_LANES(Lt, <)
SDLC_TWO_LANES(Le, <=)
SDLC_TWO_LANES(Gt, >)
SDLC_TWO_LANES(Ge, >=)
SDLC_TWO_LANES(Eq, ==)
SDLC_TWO_LANES(Ne, !=)
#undef SDLC_TWO_LANES
template <typename T>
HWY_INLINE Mask2<T> TestBit(Vec2<T> v, Vec2<T> bit) {
  return Eq(And(v, bit), bit);
}
template <typename T>
HWY_INLINE Mask2<T> MaskFromVec(Vec2<T> v) {
  return {bits_of_lanes(v) != 0};
}
template <typename To, typename From>
HWY_INLINE Mask2<To> RebindMask(TwoLanes<To> /*d*/, Mask2<From> m) {
  return {m.raw};
}
template <typename T>
HWY_INLINE Mask2<T> And(Mask2<T> a, Mask2<T> b) {
  return {a.raw & b.raw};
}
template <typename T>
HWY_INLINE Mask2<T> AndNot(Mask2<T> a, Mask2<T> b) {
  return {~a.raw & b.raw};
}
template <typename T>
HWY_INLINE Mask2<T> Or(Mask2<T> a, Mask2<T> b) {
  return {a.raw | b.raw};
}
template <typename T>
HWY_INLINE Mask2<T> Xor(Mask2<T> a, Mask2<T> b) {
  return {a.raw ^ b.raw};
}
template <typename T>
HWY_INLINE Mask2<T> Not(Mask2<T> m) {
  return {~m.raw};
}
template <typename T>
HWY_INLINE bool AllFalse(TwoLanes<T> /*d*/, Mask2<T> m) {
  return (m.raw[0] | m.raw[1]) == 0;
}
template <typename T>
HWY_INLINE std::size_t CountTrue(TwoLanes<T> /*d*/, Mask2<T> m) {
  return static_cast<std::size_t>(-(m.raw[0] + m.raw[1]));
}
template <typename T>
HWY_INLINE std::size_t StoreMaskBits(TwoLanes<T> /*d*/, Mask2<T> m, std::uint8_t* bits) {
  *bits = static_cast<std::uint8_t>((m.raw[0] & 1) | (m.raw[1] & 2));
  return 1;
}

}  // namespace hwy::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif

HWY_BEFORE_NAMESPACE();
namespace sdlc::render::HWY_NAMESPACE {

/// Whether this is the portable backend.
inline constexpr bool kIsPortable = HWY_TARGET == HWY_SCALAR;

/// The largest vectors.
#if HWY_TARGET == HWY_SCALAR
template <typename T>
using Lanes = hwy::HWY_NAMESPACE::TwoLanes<T>;
#else
template <typename T>
using Lanes = hwy::HWY_NAMESPACE::ScalableTag<T>;
#endif

}  // namespace sdlc::render::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
