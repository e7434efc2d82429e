#pragma once

#include <cstdint>

#include "render/scene/scene.hpp"
#include "render/shading/owen.hpp"

namespace sdlc::render {

/// The finaliser of SplitMix64 (Steele, Lea, Flood, "Fast splittable pseudorandom number
/// generators", 2014).
constexpr std::uint64_t mix_bits(std::uint64_t z) noexcept {
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
  return z ^ (z >> 31);
}

/// Two rounds of multiply and shift, with the factors of "lowbias32" from Wellons' search for
/// 32-bit mixers ("Hash prospector", github.com/skeeto/hash-prospector), with a key that selects
/// one of 2^32 such mixers. A bijection of `x`. The high bits are the best; the low ones depend on
/// fewer bits of `x`.
constexpr std::uint32_t mix_bits(std::uint32_t x, std::uint32_t key) noexcept {
  x = (x ^ (x >> 16)) * 0x7FEB352D + key;
  return (x ^ (x >> 15)) * 0x846CA68B;
}

/// The use of each pair of dimensions. A vertex of the path has its own pairs, independent of what
/// earlier surfaces used.
enum CameraPair : std::uint32_t { kPixel, kTime, kCameraPairs };
enum VertexPair : std::uint32_t {
  kDirection,  ///< scattered direction: height on the sphere and azimuth
  kChoice,     ///< first: selects one of several events, or the distance in a ball
  kLight,      ///< direction within the cone of an emitter
  kVertexPairs,
};
constexpr std::uint32_t vertex_pair(int vertex, VertexPair pair) noexcept {
  return kCameraPairs + static_cast<std::uint32_t>(vertex) * kVertexPairs + pair;
}

/// Two random numbers, each uniform in [0, 1), never 1.
struct UniformPair {
  double first, second;
};

/// The random numbers of one camera path: a function of (seed, pixel, replicate, sample, dimension)
/// only, so the picture does not depend on the assignment of work to threads or its order. Uses
/// 32-bit arithmetic, so wide kernels compute the same numbers in every lane. Numbers come in
/// pairs. With SamplerKind::Sobol the pairs of the first 2^k samples of a stream are a (0, k,
/// 2)-net in base 2, for any k, and different pairs are independent.
class PathSampler {
 public:
  /// The step between consecutive samples and words before mixing: 2^32 divided by the golden
  /// ratio, odd.
  static constexpr std::uint32_t kIncrement = 0x9E3779B9;
  static constexpr std::uint32_t kWordsPerPair = 3;  ///< used per pair
  static constexpr std::uint32_t kPairIncrement = kWordsPerPair * kIncrement;

  /// `stream_key`: see stream_key(). `sample`: index in the stream, from 0.
  PathSampler(SamplerKind kind, std::uint64_t stream_key, std::uint32_t sample) noexcept
      : kind_(kind),
        mixer_(static_cast<std::uint32_t>(stream_key >> 32)),
        order_(reversed_bits(sample)) {
    // For Sobol' points the words select the scrambling, which is the same for all samples.
    const std::uint32_t own = kind == SamplerKind::Independent ? sample : 0;
    start_ = mix_bits(static_cast<std::uint32_t>(stream_key) + own * kIncrement, mixer_);
    start_ ^= start_ >> 16;
  }

  /// The stream key of all samples of one replicate of a pixel; `replicate` below 4.
  static std::uint64_t stream_key(std::uint64_t seed, std::uint64_t pixel,
                                  std::uint64_t replicate) noexcept {
    constexpr std::uint64_t kIncrement64 = 0x9E3779B97F4A7C15;  // 2^64 divided by the golden ratio,
                                                                // odd
    const std::uint64_t stream = 4 * pixel + replicate;
    return mix_bits(mix_bits(seed + kIncrement64) ^ (stream + kIncrement64));
  }

  /// The numbers of a pair; multiples of 2^-32.
  UniformPair pair(std::uint32_t index) const noexcept {
    const std::uint32_t base = start_ + index * kPairIncrement;
    const auto word = [&](std::uint32_t i) {
      return mix_bits(base + (i + 1) * kIncrement, mixer_);
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

}  // namespace sdlc::render
