#pragma once

#include <cstdint>

/// The random numbers of a camera path are a function of (seed, pixel, replicate, sample,
/// dimension) only, so the picture does not depend on the assignment of work to threads or its
/// order. They come in pairs from 32-bit words. With SamplerKind::Sobol the pairs of the first 2^k
/// samples of a stream are a (0, k, 2)-net in base 2, for any k, and different pairs are
/// independent.
namespace sdlc::render {

/// The finaliser of SplitMix64 (Steele, Lea, Flood, "Fast splittable pseudorandom number
/// generators", 2014).
constexpr std::uint64_t mix_bits(std::uint64_t z) noexcept {
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
  return z ^ (z >> 31);
}

/// The use of each pair of dimensions. A vertex of the path has its own pairs, independent of what
/// earlier surfaces used.
enum CameraPair : std::uint32_t {
  kPixel,
  kTime,
  kCameraPairs,  ///< the pairs of the first vertex start here
  /// The point on the lens. The pairs of vertices only count upwards, so the one before the first
  /// pair is free: a lens changes no other random number.
  kLens = 0xFFFFFFFF,
};
enum VertexPair : std::uint32_t {
  kDirection,  ///< scattered direction: height on the sphere and azimuth
  kChoice,     ///< selects one of several events or the distance in a ball, and the light
  kLight,      ///< direction within the cone of an emitter
  kVertexPairs,
  /// Connections by way of mirrors and glass. The pairs of vertices do not get this far.
  kCaster = 0x20000000,  ///< selects the caster
  kCausticLight,         ///< first: selects the light; second: the number of chords
  kBeam,                 ///< first: selects the beam
  kCausticDirection,     ///< in the beam
  kGlint,                ///< first: selects an image of a light in the pixel
  kGlintPlace,           ///< in that image
};

/// The step between consecutive samples and words before mixing: 2^32 divided by the golden ratio,
/// odd.
inline constexpr std::uint32_t kWordIncrement = 0x9E3779B9;
inline constexpr std::uint32_t kWordsPerPair = 3;
inline constexpr std::uint32_t kPairIncrement = kWordsPerPair * kWordIncrement;

/// The key of all samples of one replicate of a pixel; `replicate` below 4. The lower half is the
/// start of the stream, the upper half its mixer.
constexpr std::uint64_t stream_key(std::uint64_t seed, std::uint64_t pixel,
                                   std::uint64_t replicate) noexcept {
  constexpr std::uint64_t kIncrement = 0x9E3779B97F4A7C15;  // 2^64 divided by the golden ratio, odd
  const std::uint64_t stream = 4 * pixel + replicate;
  return mix_bits(mix_bits(seed + kIncrement) ^ (stream + kIncrement));
}

}  // namespace sdlc::render
