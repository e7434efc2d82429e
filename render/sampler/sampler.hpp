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

/// The random numbers of one camera path: a function of (seed, pixel, sample, dimension) and of
/// nothing else, so that the picture does not depend on who computes which part of it, or in which
/// order.
class PathSampler {
 public:
  PathSampler(std::uint64_t pixel_key, std::uint64_t sample) noexcept
      : key_(mix_bits(pixel_key ^ (sample + kIncrement))) {}

  /// `pixel_key` for all samples of one pixel.
  static std::uint64_t pixel_key(std::uint64_t seed, std::uint64_t pixel) noexcept {
    return mix_bits(mix_bits(seed + kIncrement) ^ (pixel + kIncrement));
  }

  /// Uniform in [0, 1), never 1: a multiple of 2^-53.
  double uniform(std::uint32_t dimension) const noexcept {
    const std::uint64_t bits = mix_bits(key_ + (dimension + 1) * kIncrement);
    return static_cast<double>(bits >> 11) * 0x1p-53;
  }

 private:
  static constexpr std::uint64_t kIncrement =
      0x9E3779B97F4A7C15;  // 2^64 over the golden ratio, odd

  std::uint64_t key_;
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
