// Highway 1.0.3, with vectors of doubles for its target WASM, which has only those of floats. Each is rounded and ordered
// as its SSE4 namesake, and so is the minimum of floats here, which is one instruction then.
#pragma once

#include_next <hwy/highway.h>

#if HWY_TARGET == HWY_WASM && !HWY_HAVE_FLOAT64
#undef HWY_HAVE_FLOAT64
#define HWY_HAVE_FLOAT64 1

namespace hwy::HWY_NAMESPACE {

template <size_t N>
using Doubles = Vec128<double, N>;
template <size_t N>
using DoublesMask = Mask128<double, N>;

template <size_t N, HWY_IF_LE128(double, N)>
HWY_API Doubles<N> Set(Simd<double, N, 0> /* tag */, const double t) {
  return {wasm_f64x2_splat(t)};
}

#define SDLC_DOUBLES_BINARY(name, instruction)                    \
  template <size_t N>                                             \
  HWY_API Doubles<N> name(const Doubles<N> a, const Doubles<N> b) { \
    return {instruction(a.raw, b.raw)};                           \
  }
SDLC_DOUBLES_BINARY(operator+, wasm_f64x2_add)
SDLC_DOUBLES_BINARY(operator-, wasm_f64x2_sub)
SDLC_DOUBLES_BINARY(operator*, wasm_f64x2_mul)
SDLC_DOUBLES_BINARY(operator/, wasm_f64x2_div)
#undef SDLC_DOUBLES_BINARY

#define SDLC_DOUBLES_UNARY(name, instruction)   \
  template <size_t N>                           \
  HWY_API Doubles<N> name(const Doubles<N> v) { \
    return {instruction(v.raw)};                \
  }
SDLC_DOUBLES_UNARY(Abs, wasm_f64x2_abs)
SDLC_DOUBLES_UNARY(Sqrt, wasm_f64x2_sqrt)
SDLC_DOUBLES_UNARY(Round, wasm_f64x2_nearest)
SDLC_DOUBLES_UNARY(Trunc, wasm_f64x2_trunc)
SDLC_DOUBLES_UNARY(Ceil, wasm_f64x2_ceil)
SDLC_DOUBLES_UNARY(Floor, wasm_f64x2_floor)
#undef SDLC_DOUBLES_UNARY

#define SDLC_DOUBLES_COMPARISON(name, instruction)                    \
  template <size_t N>                                                 \
  HWY_API DoublesMask<N> name(const Doubles<N> a, const Doubles<N> b) { \
    return {instruction(a.raw, b.raw)};                               \
  }
SDLC_DOUBLES_COMPARISON(operator==, wasm_f64x2_eq)
SDLC_DOUBLES_COMPARISON(operator!=, wasm_f64x2_ne)
SDLC_DOUBLES_COMPARISON(operator>, wasm_f64x2_gt)
SDLC_DOUBLES_COMPARISON(operator<=, wasm_f64x2_le)
SDLC_DOUBLES_COMPARISON(operator>=, wasm_f64x2_ge)
#undef SDLC_DOUBLES_COMPARISON

// As minpd and maxpd, which return the second operand if one is NaN or both are zero; with swapped operands that is what
// pmin and pmax do.
template <size_t N>
HWY_API Doubles<N> Min(const Doubles<N> a, const Doubles<N> b) {
  return {wasm_f64x2_pmin(b.raw, a.raw)};
}
template <size_t N>
HWY_API Doubles<N> Max(const Doubles<N> a, const Doubles<N> b) {
  return {wasm_f64x2_pmax(b.raw, a.raw)};
}
// Preferred to the templates of Highway.
HWY_API Vec128<float> Min(const Vec128<float> a, const Vec128<float> b) {
  return {wasm_f32x4_pmin(b.raw, a.raw)};
}
HWY_API Vec128<float> Max(const Vec128<float> a, const Vec128<float> b) {
  return {wasm_f32x4_pmax(b.raw, a.raw)};
}

template <size_t N>
HWY_API Doubles<N> MulAdd(const Doubles<N> mul, const Doubles<N> x, const Doubles<N> add) {
  return mul * x + add;
}
template <size_t N>
HWY_API Doubles<N> NegMulAdd(const Doubles<N> mul, const Doubles<N> x, const Doubles<N> add) {
  return add - mul * x;
}
template <size_t N>
HWY_API Doubles<N> MulSub(const Doubles<N> mul, const Doubles<N> x, const Doubles<N> sub) {
  return mul * x - sub;
}

template <size_t N>
HWY_API Doubles<N> PromoteTo(Simd<double, N, 0> /* tag */, const Vec128<float, N> v) {
  return {wasm_f64x2_promote_low_f32x4(v.raw)};
}
template <size_t N>
HWY_API Vec128<float, N> DemoteTo(Simd<float, N, 0> /* tag */, const Doubles<N> v) {
  return {wasm_f32x4_demote_f64x2_zero(v.raw)};
}
template <size_t N>
HWY_API Doubles<N> ConvertTo(Simd<double, N, 0> /* tag */, const Vec128<int64_t, N> v) {
  return {wasm_f64x2_make(static_cast<double>(wasm_i64x2_extract_lane(v.raw, 0)),
                          static_cast<double>(wasm_i64x2_extract_lane(v.raw, 1)))};
}

}  // namespace hwy::HWY_NAMESPACE

#endif
