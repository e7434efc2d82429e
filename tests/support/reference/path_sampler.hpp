#pragma once

#include <cstdint>

#include "render/scene/settings.hpp"
#include "render/shading/sampler.hpp"

/// The random numbers of render/shading/lane_sampler-inl.h, which has the sources, one at a time.
namespace sdlc::test::reference {

using namespace render;  // NOLINT

constexpr std::uint32_t mix_bits(std::uint32_t x, std::uint32_t key) noexcept {
  x = (x ^ (x >> 16)) * 0x7FEB352D + key;
  return (x ^ (x >> 15)) * 0x846CA68B;
}

constexpr std::uint32_t reversed_bits(std::uint32_t x) noexcept {
  x = (x & 0x55555555u) << 1 | (x >> 1 & 0x55555555u);
  x = (x & 0x33333333u) << 2 | (x >> 2 & 0x33333333u);
  x = (x & 0x0F0F0F0Fu) << 4 | (x >> 4 & 0x0F0F0F0Fu);
  x = (x & 0x00FF00FFu) << 8 | (x >> 8 & 0x00FF00FFu);
  return x << 16 | x >> 16;
}

inline constexpr std::uint32_t kScramble[]{0x3D20ADEA, 0x05526C56, 0x53A22864};

constexpr std::uint32_t scramble_upwards(std::uint32_t x, std::uint32_t key) noexcept {
  x ^= x * kScramble[0];
  x += key;
  x *= key >> 16 | 1;
  x ^= x * kScramble[1];
  return x ^ x * kScramble[2];
}

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

constexpr std::uint32_t vertex_pair(int vertex, VertexPair pair) noexcept {
  return kCameraPairs + static_cast<std::uint32_t>(vertex) * kVertexPairs + pair;
}

/// Two random numbers, each uniform in [0, 1), never 1.
struct UniformPair {
  double first, second;
};

/// The random numbers of one camera path.
class PathSampler {
 public:
  /// `stream_key`: see render::stream_key(). `sample`: index in the stream, from 0.
  PathSampler(SamplerKind kind, std::uint64_t stream_key, std::uint32_t sample) noexcept
      : kind_(kind),
        mixer_(static_cast<std::uint32_t>(stream_key >> 32)),
        order_(reversed_bits(sample)) {
    // For Sobol' points the words select the scrambling, which is the same for all samples.
    const std::uint32_t own = kind == SamplerKind::Independent ? sample : 0;
    start_ = mix_bits(static_cast<std::uint32_t>(stream_key) + own * kWordIncrement, mixer_);
    start_ ^= start_ >> 16;
  }

  /// What the words are computed from.
  std::uint32_t start() const noexcept { return start_; }

  /// The numbers of a pair; multiples of 2^-32.
  UniformPair pair(std::uint32_t index) const noexcept {
    const std::uint32_t base = start_ + index * kPairIncrement;
    const auto word = [&](std::uint32_t i) {
      return mix_bits(base + (i + 1) * kWordIncrement, mixer_);
    };
    if (kind_ == SamplerKind::Independent) return {word(0) * 0x1p-32, word(1) * 0x1p-32};
    const ScrambledPoint point = scrambled_sobol(order_, word(0), word(1), word(2));
    return {point.x * 0x1p-32, point.y * 0x1p-32};
  }

 private:
  SamplerKind kind_;
  std::uint32_t mixer_;
  std::uint32_t order_;  // index of the sample, bits reversed
  std::uint32_t start_;
};

}  // namespace sdlc::test::reference
