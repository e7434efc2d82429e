#pragma once

#include <cstdint>

namespace sdlc::render {

/// The finaliser of SplitMix64 (Steele, Lea, Flood, "Fast splittable pseudorandom number
/// generators", 2014).
constexpr std::uint64_t mix_bits(std::uint64_t z) noexcept {
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
  return z ^ (z >> 31);
}

/// Two rounds of multiplying and shifting, with the factors of "lowbias32" from Wellons' search for
/// 32-bit mixers ("Hash prospector", github.com/skeeto/hash-prospector), here with a key that picks
/// one of 2^32 such mixers. A bijection of `x`. The high bits are the best; the low ones have seen
/// less of `x`.
constexpr std::uint32_t mix_bits(std::uint32_t x, std::uint32_t key) noexcept {
  x = (x ^ (x >> 16)) * 0x7FEB352D + key;
  return (x ^ (x >> 15)) * 0x846CA68B;
}

/// The random numbers of one camera path: a function of (seed, pixel, sample, dimension) and of
/// nothing else, so that the picture does not depend on who computes which part of it, or in which
/// order. 32-bit arithmetic alone, so that wide kernels compute the same numbers in every lane.
class PathSampler {
 public:
  /// What consecutive samples and dimensions are apart before they are mixed: 2^32 over the golden
  /// ratio, odd.
  static constexpr std::uint32_t kIncrement = 0x9E3779B9;

  PathSampler(std::uint64_t pixel_key, std::uint64_t sample) noexcept
      : mixer_(static_cast<std::uint32_t>(pixel_key >> 32)),
        start_(mix_bits(
            static_cast<std::uint32_t>(pixel_key) + static_cast<std::uint32_t>(sample) * kIncrement,
            mixer_)) {
    start_ ^= start_ >> 16;
  }

  /// `pixel_key` for all samples of one pixel.
  static std::uint64_t pixel_key(std::uint64_t seed, std::uint64_t pixel) noexcept {
    constexpr std::uint64_t kIncrement64 = 0x9E3779B97F4A7C15;  // 2^64 over the golden ratio, odd
    return mix_bits(mix_bits(seed + kIncrement64) ^ (pixel + kIncrement64));
  }

  /// Uniform in [0, 1), never 1: a multiple of 2^-32.
  double uniform(std::uint32_t dimension) const noexcept {
    return mix_bits(start_ + (dimension + 1) * kIncrement, mixer_) * 0x1p-32;
  }

 private:
  std::uint32_t mixer_;
  std::uint32_t start_;
};

/// What each dimension decides. A vertex of the path has its own block of dimensions, whatever the
/// surfaces before it asked for.
enum CameraDimension : std::uint32_t { kPixelX, kPixelY, kTime, kCameraDimensions };
enum VertexDimension : std::uint32_t {
  kDirectionZ,     ///< scattered direction: height on the sphere
  kDirectionTurn,  ///< and angle around it
  kChoice,         ///< reflect or refract
  kRadiusA,
  kRadiusB,
  kRadiusC,  ///< the largest of three is the radius of a uniform point in a ball
  kVertexDimensions,
};
constexpr std::uint32_t vertex_dimension(int vertex, VertexDimension dimension) noexcept {
  return kCameraDimensions + static_cast<std::uint32_t>(vertex) * kVertexDimensions + dimension;
}

}  // namespace sdlc::render
