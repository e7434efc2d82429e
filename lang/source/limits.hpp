#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

/// What no file may exceed, in one place.
namespace sdlc::lang {

/// Brackets inside brackets, in both formats. Whatever walks a tree recursively relies on it.
inline constexpr int kMaxNesting = 128;

/// Bytes of a text whose brackets and foreign spellings are mended before it is read again. Longer
/// ones are hardly written by hand, and the search for the likeliest mistake takes some 5
/// microseconds a byte.
inline constexpr std::size_t kMaxMendedText = std::size_t{256} << 10;

/// Calls inside calls of functions of the file's own.
inline constexpr int kMaxCalls = 128;

/// Expressions and statements inside each other while they are evaluated, through calls and
/// instances: what the machine's stack holds.
inline constexpr int kMaxEvaluationDepth = 2000;

/// Steps that instances and includes count, in proportion to the time they take: a call and a turn
/// of a loop, 0.1 to 0.3 microseconds, count one. An included file is run each time.
inline constexpr std::uint64_t kInstanceSteps = 8;
inline constexpr std::uint64_t kIncludeSteps = 50;
inline constexpr std::uint64_t kIncludedBytesPerStep = 32;

/// What one evaluation may use up. Each has a flag, `--limit NAME=N`, and an error of its own.
struct Limits {
  std::uint64_t steps = 100'000'000;              ///< of work: about half a minute
  std::uint64_t objects = 100'000'000;            ///< spheres and instances
  std::uint64_t string = std::uint64_t{1} << 20;  ///< bytes of one string
  std::uint64_t include_depth = 32;               ///< files inside files
  std::uint64_t file = std::uint64_t{256} << 20;  ///< bytes of one .scene file
};

/// One row of the table of limits: its name in `--limit` and in messages.
struct LimitInfo {
  std::string_view name;
  std::uint64_t Limits::*limit;
  std::string_view doc;
};

inline constexpr std::array<LimitInfo, 5> kLimits{{
    {"steps", &Limits::steps,
     "steps of one evaluation: a turn of a loop and a call are 1, an instance is 8, an include 50 "
     "and 1 for every 32 bytes of its file"},
    {"objects", &Limits::objects, "spheres of a scene; an instance of many is 3"},
    {"string", &Limits::string, "bytes of one string"},
    {"include-depth", &Limits::include_depth, "files that import or include each other"},
    {"file", &Limits::file, "bytes of one .scene file"},
}};

}  // namespace sdlc::lang
