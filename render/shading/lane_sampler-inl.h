// Random numbers of every lane. Compiled once per instruction set, so it has no include guard but
// Highway's.
// clang-format off
#if defined(SDLC_RENDER_SHADING_LANE_SAMPLER_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SDLC_RENDER_SHADING_LANE_SAMPLER_INL_H
#undef SDLC_RENDER_SHADING_LANE_SAMPLER_INL_H
#else
#define SDLC_RENDER_SHADING_LANE_SAMPLER_INL_H
#endif
// clang-format on

#include <cstdint>

#include <hwy/highway.h>

#include "render/lanes/vector_math-inl.h"
#include "render/scene/settings.hpp"
#include "render/shading/sampler.hpp"

HWY_BEFORE_NAMESPACE();
namespace sdlc::render::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Two rounds of multiply and shift, with the factors of "lowbias32" from Wellons' search for
/// 32-bit mixers ("Hash prospector", github.com/skeeto/hash-prospector), with a key that selects
/// one of 2^32 such mixers. A bijection of `x`. The high bits are the best; the low ones depend on
/// fewer bits of `x`.
template <typename V>
HWY_INLINE V mix_lanes(V x, V key) {
  x = add_low_32(mul_low_32(hn::Xor(x, hn::ShiftRight<16>(x)), 0x7FEB352D), key);
  return mul_low_32(hn::Xor(x, hn::ShiftRight<15>(x)), 0x846CA68B);
}

/// Converts 32 bits to a number in [0, 1); float keeps 24 of them, double all.
template <typename D, typename V>
HWY_INLINE hn::Vec<D> uniform_from_bits(D d, V bits) {
  if constexpr (sizeof(hn::TFromD<D>) == 4) {
    const hn::RebindToSigned<D> di;
    return hn::Mul(hn::ConvertTo(d, hn::BitCast(di, hn::ShiftRight<8>(bits))),
                   hn::Set(d, 0x1p-24f));
  } else {
    const hn::RebindToUnsigned<D> du;
    // Puts the bits into the low part of the significand of a number from 2^52 on.
    const auto magic = hn::Set(d, 0x1p52);
    const auto number = hn::BitCast(d, hn::Or(bits, hn::BitCast(du, magic)));
    return hn::Mul(hn::Sub(number, magic), hn::Set(d, 0x1p-32));
  }
}

/// Factors of scramble_lanes_upwards; even, because x is combined with its own product.
inline constexpr std::uint32_t kScramble[]{0x3D20ADEA, 0x05526C56, 0x53A22864};

/// Nested uniform scrambling (Owen, "Randomly permuted (t,m,s)-nets and (t,s)-sequences", 1995) of
/// a fraction whose bits are reversed: a bijection in which every bit depends only on itself and
/// the bits below it. Uses a hash instead of a tree of random bits (Laine, Karras, "Stratified
/// sampling for stochastic transparency", 2011; Burley, "Practical hash-based Owen scrambling",
/// 2020; factors from Vegdahl's search, psychopath.io, 2021). The low bits of `key` must be as
/// random as the high ones.
template <typename V>
HWY_INLINE V scramble_lanes_upwards(V x, V key) {
  const hn::DFromV<V> du;
  x = hn::Xor(x, mul_low_32(x, kScramble[0]));
  x = add_low_32(x, key);
  x = mul_low_32(x, hn::Or(hn::ShiftRight<16>(key), hn::Set(du, 1)));
  x = hn::Xor(x, mul_low_32(x, kScramble[1]));
  return hn::Xor(x, mul_low_32(x, kScramble[2]));
}

/// The second dimension of Sobol's sequence (the first is van der Corput's). Bit k of the fraction,
/// from the top, is the sum modulo 2 of binomial(j, k) over the set bits j of the index;
/// binomial(j, k) is odd where the ones of k are a subset of the ones of j (Lucas). Takes an index
/// and returns a fraction with reversed bits: a sum over supersets, in five steps.
template <typename V>
HWY_INLINE V sobol_second_reversed_lanes(V index) {
  const hn::DFromV<V> du;
  using Word = hn::TFromV<V>;
  const auto upper = [&](V v, Word mask) HWY_ATTR { return hn::And(v, hn::Set(du, mask)); };
  index = hn::Xor(index, hn::ShiftRight<16>(index));
  index = hn::Xor(index, hn::ShiftRight<8>(upper(index, 0xFF00FF00u)));
  index = hn::Xor(index, hn::ShiftRight<4>(upper(index, 0xF0F0F0F0u)));
  index = hn::Xor(index, hn::ShiftRight<2>(upper(index, 0xCCCCCCCCu)));
  return hn::Xor(index, hn::ShiftRight<1>(upper(index, 0xAAAAAAAAu)));
}

/// The random numbers of a path, or of one of its vertices.
template <typename D>
class LaneSampler {
 public:
  using V = hn::Vec<D>;
  using Bits = hn::Vec<hn::RebindToUnsigned<D>>;
  struct Pair {
    V first, second;
  };

  /// `start`: CameraRays::stream_start() plus the increments up to the first pair. `order`: the
  /// index of the sample, with its bits reversed.
  HWY_INLINE LaneSampler(SamplerKind kind, Bits start, Bits mixer, Bits order)
      : kind_(kind), start_(start), mixer_(mixer), order_(order) {}

  HWY_INLINE Pair pair(std::uint32_t index) const {
    if (kind_ == SamplerKind::Independent) {
      return {uniform_from_bits(D(), word(index, 0)), uniform_from_bits(D(), word(index, 1))};
    }
    const Bits place = shuffled(index);
    const Bits x = scramble_lanes_upwards(place, key(word(index, 1)));
    const Bits y = scramble_lanes_upwards(sobol_second_reversed_lanes(place), key(word(index, 2)));
    return {uniform_from_bits(D(), reverse_lane_bits(x)),
            uniform_from_bits(D(), reverse_lane_bits(y))};
  }

  /// The first number of a pair.
  HWY_INLINE V first(std::uint32_t index) const {
    if (kind_ == SamplerKind::Independent) return uniform_from_bits(D(), word(index, 0));
    const Bits x = scramble_lanes_upwards(shuffled(index), key(word(index, 1)));
    return uniform_from_bits(D(), reverse_lane_bits(x));
  }

 private:
  HWY_INLINE Bits word(std::uint32_t pair, std::uint32_t i) const {
    const hn::RebindToUnsigned<D> du;
    const std::uint32_t offset = pair * kPairIncrement + (i + 1) * kWordIncrement;
    return mix_lanes(add_low_32(start_, hn::Set(du, offset)), mixer_);
  }
  /// The words have random high bits; a key needs random low bits, too.
  static HWY_INLINE Bits key(Bits word) { return hn::Xor(word, hn::ShiftRight<16>(word)); }
  /// Shuffles the sequence such that the first 2^k points stay together for any k.
  HWY_INLINE Bits shuffled(std::uint32_t pair) const {
    return reverse_lane_bits(scramble_lanes_upwards(order_, key(word(pair, 0))));
  }

  SamplerKind kind_;
  Bits start_, mixer_, order_;
};

}  // namespace sdlc::render::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
