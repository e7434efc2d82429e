#pragma once

#include <cstdint>

namespace sdlc::render {

constexpr std::uint32_t reversed_bits(std::uint32_t x) noexcept {
  x = (x & 0x55555555u) << 1 | (x >> 1 & 0x55555555u);
  x = (x & 0x33333333u) << 2 | (x >> 2 & 0x33333333u);
  x = (x & 0x0F0F0F0Fu) << 4 | (x >> 4 & 0x0F0F0F0Fu);
  x = (x & 0x00FF00FFu) << 8 | (x >> 8 & 0x00FF00FFu);
  return x << 16 | x >> 16;
}

/// Factors of scramble_upwards; even, because x is combined with its own product.
inline constexpr std::uint32_t kScramble[]{0x3D20ADEA, 0x05526C56, 0x53A22864};

/// Nested uniform scrambling (Owen, "Randomly permuted (t,m,s)-nets and (t,s)-sequences", 1995) of
/// a fraction whose bits are reversed: a bijection in which every bit depends only on itself and
/// the bits below it. Uses a hash instead of a tree of random bits (Laine, Karras, "Stratified
/// sampling for stochastic transparency", 2011; Burley, "Practical hash-based Owen scrambling",
/// 2020; factors from Vegdahl's search, psychopath.io, 2021). The low bits of `key` must be as
/// random as the high ones.
constexpr std::uint32_t scramble_upwards(std::uint32_t x, std::uint32_t key) noexcept {
  x ^= x * kScramble[0];
  x += key;
  x *= key >> 16 | 1;
  x ^= x * kScramble[1];
  return x ^ x * kScramble[2];
}

/// The second dimension of Sobol's sequence (the first is van der Corput's). Bit k of the fraction,
/// from the top, is the sum modulo 2 of binomial(j, k) over the set bits j of the index;
/// binomial(j, k) is odd where the ones of k are a subset of the ones of j (Lucas). Takes an index
/// and returns a fraction with reversed bits: a sum over supersets, in five steps.
constexpr std::uint32_t sobol_second_reversed(std::uint32_t index) noexcept {
  index ^= index >> 16;
  index ^= (index & 0xFF00FF00u) >> 8;
  index ^= (index & 0xF0F0F0F0u) >> 4;
  index ^= (index & 0xCCCCCCCCu) >> 2;
  return index ^ (index & 0xAAAAAAAAu) >> 1;
}

/// The coordinates of a point in units of 2^-32.
struct ScrambledPoint {
  std::uint32_t x, y;
};

/// A point of Sobol's first two dimensions. The sequence is shuffled such that the first 2^k points
/// stay together for any k, then scrambled. The three words have random high bits. `order` is the
/// index in the sequence, with its bits reversed.
constexpr ScrambledPoint scrambled_sobol(std::uint32_t order, std::uint32_t shuffle,
                                         std::uint32_t x, std::uint32_t y) noexcept {
  const auto key = [](std::uint32_t word) { return word ^ word >> 16; };
  const std::uint32_t index = reversed_bits(scramble_upwards(order, key(shuffle)));
  return {reversed_bits(scramble_upwards(index, key(x))),
          reversed_bits(scramble_upwards(sobol_second_reversed(index), key(y)))};
}

}  // namespace sdlc::render
