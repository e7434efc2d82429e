#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <type_traits>

#include "render/film/film_file.hpp"
#include "render/math/fnv.hpp"

/// The format of film files, for those who write and read them.
namespace sdlc::render {

static_assert(std::endian::native == std::endian::little, "numbers in the file are little-endian");

// The file is the mark, the version and sections. A section is its tag, the size of its content,
// the content, and the checksum of all three. The section `end ` is the last.
inline constexpr std::string_view kMark = "sdlcfilm";
inline constexpr std::uint32_t kVersion = 1;
using Tag = std::array<char, 4>;
inline constexpr Tag kOrigin{'o', 'r', 'i', 'g'}, kStatistics{'s', 't', 'a', 't'},
    kLights{'l', 'g', 'h', 't'}, kCasters{'c', 'a', 's', 't'}, kExact{'e', 'x', 'a', 'c'},
    kEmitters{'e', 'm', 'i', 't'}, kTargets{'t', 'a', 'r', 'g'}, kFilm{'f', 'i', 'l', 'm'},
    kRecord{'p', 'i', 'c', 't'}, kShards{'s', 'h', 'r', 'd'}, kClasses{'c', 'l', 'a', 's'},
    kPasses{'p', 'a', 's', 's'}, kEnd{'e', 'n', 'd', ' '};

/// A film as it is stored, before the counts by pixel and replicate and then the values of each
/// sum.
struct StoredExtent {
  std::uint64_t first_pixel, pixels;
  std::uint32_t first_sample, replicates;
  std::uint64_t has_first_hits;  ///< 0 or 1; the sums then follow those of colours, by pixel
};
static_assert(std::has_unique_object_representations_v<StoredExtent>);

/// EmitterClasses as they are stored, before their classes and then their emitters.
struct StoredClasses {
  double brightest;
  std::uint32_t has_casters;  ///< 0 or 1
  std::uint32_t classes;
  std::uint64_t spheres;
};
struct StoredClass {
  double radiance;
  std::uint32_t sphere;
  std::array<EmitterClasses::Chance, kLightPaths> kinds;
};
static_assert(sizeof(StoredClasses) == 24 && sizeof(StoredClass) == 16, "no padding");

/// Calls `visit(pixel, replicate)` in the order of the file.
template <typename Visit>
void for_each_sum(const Film& film, Visit visit) {
  for (std::size_t pixel = 0; pixel < film.size(); ++pixel) {
    for (std::uint32_t r = 0; r < film.extent().replicates; ++r) visit(pixel, r);
  }
}

/// A number or a struct of numbers; no span, whose bytes are not those of its elements.
template <typename T>
concept Plain = std::is_arithmetic_v<T> || std::is_same_v<T, std::byte> || std::is_same_v<T, Tag> ||
    std::is_same_v<T, StoredExtent> || std::is_same_v<T, TraceCounts> ||
    std::is_same_v<T, EmitterCount> || std::is_same_v<T, FirstHitSums> ||
    std::is_same_v<T, StoredClasses> || std::is_same_v<T, StoredClass> ||
    std::is_same_v<T, GoalPass>;

template <Plain T>
std::span<const std::byte> bytes_of(const T& value) {
  return std::as_bytes(std::span(&value, 1));
}

inline void add_to(Fnv1a& hash, std::span<const std::byte> bytes) {
  for (const std::byte byte : bytes) hash.add_byte(static_cast<std::uint8_t>(byte));
}

}  // namespace sdlc::render
