// Vectors of two numbers for the portable backend, whose other vectors have one: the operations of
// Highway that the search in a BVH needs, by the vector extension of compilers. Highway's own
// emulation of 128 bits is miscompiled by g++ before 12.3 (GCC bug 106322).
// clang-format off
#if defined(SDLC_RENDER_WIDE_TWO_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SDLC_RENDER_WIDE_TWO_LANES_INL_H
#undef SDLC_RENDER_WIDE_TWO_LANES_INL_H
#else
#define SDLC_RENDER_WIDE_TWO_LANES_INL_H
#endif
// clang-format on

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include <hwy/highway.h>

#if HWY_TARGET == HWY_SCALAR
HWY_BEFORE_NAMESPACE();
namespace hwy::HWY_NAMESPACE {  // where templates look for operations

using TwoLanes = Simd<double, 2, 0>;
struct Vec2 {
  using Raw = double __attribute__((vector_size(16)));
  Raw raw;
};
struct Mask2 {
  using Raw = std::int64_t __attribute__((vector_size(16)));
  Raw raw;
};

HWY_INLINE Vec2 Set(TwoLanes /*d*/, double v) { return {Vec2::Raw{v, v}}; }
HWY_INLINE Vec2 Zero(TwoLanes /*d*/) { return {Vec2::Raw{}}; }
HWY_INLINE Vec2 Load(TwoLanes /*d*/, const double* from) {
  Vec2 v;
  std::memcpy(&v.raw, from, sizeof v.raw);
  return v;
}
HWY_INLINE void Store(Vec2 v, TwoLanes /*d*/, double* to) { std::memcpy(to, &v.raw, sizeof v.raw); }

HWY_INLINE Vec2 Add(Vec2 a, Vec2 b) { return {a.raw + b.raw}; }
HWY_INLINE Vec2 Sub(Vec2 a, Vec2 b) { return {a.raw - b.raw}; }
HWY_INLINE Vec2 Mul(Vec2 a, Vec2 b) { return {a.raw * b.raw}; }
HWY_INLINE Vec2 MulAdd(Vec2 a, Vec2 b, Vec2 c) { return {a.raw * b.raw + c.raw}; }
HWY_INLINE Vec2 MulSub(Vec2 a, Vec2 b, Vec2 c) { return {a.raw * b.raw - c.raw}; }
HWY_INLINE Vec2 NegMulAdd(Vec2 a, Vec2 b, Vec2 c) { return {c.raw - a.raw * b.raw}; }
HWY_INLINE Vec2 Sqrt(Vec2 v) { return {Vec2::Raw{std::sqrt(v.raw[0]), std::sqrt(v.raw[1])}}; }
HWY_INLINE Vec2 Max(Vec2 a, Vec2 b) { return {a.raw > b.raw ? a.raw : b.raw}; }
HWY_INLINE Vec2 Min(Vec2 a, Vec2 b) { return {a.raw < b.raw ? a.raw : b.raw}; }

HWY_INLINE Mask2 MaskFromVec(Vec2 v) { return {v.raw != 0}; }
HWY_INLINE Mask2 Le(Vec2 a, Vec2 b) { return {a.raw <= b.raw}; }
HWY_INLINE Mask2 Ge(Vec2 a, Vec2 b) { return {a.raw >= b.raw}; }
HWY_INLINE Mask2 And(Mask2 a, Mask2 b) { return {a.raw & b.raw}; }
HWY_INLINE bool AllFalse(TwoLanes /*d*/, Mask2 m) { return (m.raw[0] | m.raw[1]) == 0; }
HWY_INLINE Vec2 IfThenElse(Mask2 m, Vec2 yes, Vec2 no) { return {m.raw ? yes.raw : no.raw}; }
HWY_INLINE std::size_t StoreMaskBits(TwoLanes /*d*/, Mask2 m, std::uint8_t* bits) {
  *bits = static_cast<std::uint8_t>((m.raw[0] & 1) | (m.raw[1] & 2));
  return 1;
}

}  // namespace hwy::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

namespace sdlc::render::HWY_NAMESPACE {
using TwoLanes = hwy::HWY_NAMESPACE::TwoLanes;
}
#endif

#endif
