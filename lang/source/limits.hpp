#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

/// All limits on files and their evaluation.
namespace sdlc::lang {

/// Nested brackets, prefixes and conditionals, in both formats. It bounds the recursion over trees.
inline constexpr int kMaxNesting = 128;

/// Steps of work. A step is about 10 nanoseconds, the time of an operation on two numbers; longer
/// work counts in proportion to its time. `bench/hostile.py` measures whether the counts are right.
namespace work {
inline constexpr std::uint64_t kStatement = 2, kProperty = 3, kTurn = 2;
inline constexpr std::uint64_t kCall = 8, kInstance = 80, kGroup = 15, kList = 8;
inline constexpr std::uint64_t kRotation = 400;     ///< per group: six sines and cosines
inline constexpr std::uint64_t kSlot = 4;           ///< per slot of a call frame
inline constexpr std::uint64_t kBytes = 16;         ///< bytes of a string per step
inline constexpr std::uint64_t kInclude = 500;      ///< in addition to the bytes of its file
inline constexpr std::uint64_t kIncludedByte = 2;   ///< per byte of a file that is included again
inline constexpr std::uint64_t kSpheres = 100'000;  ///< spheres that double the limit
}  // namespace work

/// Limits of a pack in addition to those of its files. A pack that `sdlc pack` writes keeps them.
namespace pack_limits {
inline constexpr std::size_t kFiles = 10'000;
inline constexpr std::size_t kName = 1000;                    ///< bytes of a path in a pack
inline constexpr std::size_t kIndex = std::size_t{64} << 10;  ///< bytes of its index
/// Bytes of a file per byte that it takes in the pack. A text seldom has 50.
inline constexpr std::uint64_t kRatio = 250;
}  // namespace pack_limits

/// Resource limits of one evaluation. Each has a flag, `--limit NAME=N`, and its own error.
struct Limits {
  std::uint64_t steps = 100'000'000;                ///< of work: about a second
  std::uint64_t memory = std::uint64_t{1} << 30;    ///< bytes of all values and objects
  std::uint64_t objects = 100'000'000;              ///< spheres and instances
  std::uint64_t calls = 10'000;                     ///< nested calls of fns and instances of defs
  std::uint64_t string = std::uint64_t{1} << 20;    ///< bytes of one string
  std::uint64_t include_depth = 32;                 ///< nested imports and includes
  std::uint64_t file = std::uint64_t{32} << 20;     ///< bytes of one .scene file
  std::uint64_t config = std::uint64_t{256} << 20;  ///< bytes of one JSON config
  std::uint64_t data = std::uint64_t{256} << 20;    ///< bytes of one data file

  /// For a file of unknown format.
  constexpr std::uint64_t any_file() const noexcept { return std::max({file, config, data}); }
};

/// A row of the table of limits.
struct LimitInfo {
  std::string_view name;  ///< in `--limit` and in messages
  std::uint64_t Limits::*limit;
  std::string_view doc;
};

inline constexpr std::array<LimitInfo, 9> kLimits{{
    {"steps", &Limits::steps,
     "steps of one evaluation, about 10 nanoseconds each: operations, calls, iterations of loops, "
     "elements of lists, bytes of strings; each sphere allows a hundred-thousandth more"},
    {"memory", &Limits::memory,
     "bytes of all strings, lists, spheres and instances, and of deep calls; a sphere takes 64"},
    {"objects", &Limits::objects, "spheres of a scene; an instance of several counts as 3"},
    {"calls", &Limits::calls, "calls of functions and instances of kinds inside each other"},
    {"string", &Limits::string, "bytes of one string"},
    {"include-depth", &Limits::include_depth, "nested imports and includes"},
    {"file", &Limits::file, "bytes of one .scene file"},
    {"config", &Limits::config, "bytes of one JSON config"},
    {"data", &Limits::data, "bytes of one data file"},
}};

}  // namespace sdlc::lang
