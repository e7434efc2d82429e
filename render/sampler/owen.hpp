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

/// Factors of scramble_upwards: even, where x is taken into itself.
inline constexpr std::uint32_t kScramble[]{0x3D20ADEA, 0x05526C56, 0x53A22864};

/// A bijection in which every bit depends on those below it and on itself alone: nested uniform
/// scrambling (Owen, "Randomly permuted (t,m,s)-nets and (t,s)-sequences", 1995) of a fraction
/// whose bits are reversed, by a hash instead of a tree of random bits (Laine, Karras, "Stratified
/// sampling for stochastic transparency", 2011; Burley, "Practical hash-based Owen scrambling",
/// 2020; factors from Vegdahl's search, psychopath.io, 2021). The low bits of `key` must be as good
/// as the high ones.
constexpr std::uint32_t scramble_upwards(std::uint32_t x, std::uint32_t key) noexcept {
  x ^= x * kScramble[0];
  x += key;
  x *= key >> 16 | 1;
  x ^= x * kScramble[1];
  return x ^ x * kScramble[2];
}

/// The second dimension of Sobol's sequence, where the first is van der Corput's: bit k of the
/// fraction, from the top, is the sum modulo 2 of binomial(j, k) over the bits j of the index, and
/// that is odd where k's ones are among j's (Lucas). Of an index and to a fraction whose bits are
/// reversed: a sum over supersets, in five steps.
constexpr std::uint32_t sobol_second_reversed(std::uint32_t index) noexcept {
  index ^= index >> 16;
  index ^= (index & 0xFF00FF00u) >> 8;
  index ^= (index & 0xF0F0F0F0u) >> 4;
  index ^= (index & 0xCCCCCCCCu) >> 2;
  return index ^ (index & 0xAAAAAAAAu) >> 1;
}

/// The fractions of 2^32 of a point.
struct ScrambledPoint {
  std::uint32_t x, y;
};

/// The point of Sobol's first two dimensions at a place in the sequence, which is shuffled so that
/// the first 2^k stay together for any k, and then scrambled, by three words of which the high bits
/// are random. `order`: the place, its bits reversed.
constexpr ScrambledPoint scrambled_sobol(std::uint32_t order, std::uint32_t shuffle,
                                         std::uint32_t x, std::uint32_t y) noexcept {
  const auto key = [](std::uint32_t word) { return word ^ word >> 16; };
  const std::uint32_t index = reversed_bits(scramble_upwards(order, key(shuffle)));
  return {reversed_bits(scramble_upwards(index, key(x))),
          reversed_bits(scramble_upwards(sobol_second_reversed(index), key(y)))};
}

}  // namespace sdlc::render
