#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

/// What no file may exceed, in one place.
namespace sdlc::lang {

/// Brackets inside brackets, in both formats. Whatever walks a tree recursively relies on it.
inline constexpr int kMaxNesting = 128;

/// Calls inside calls of functions of the file's own.
inline constexpr int kMaxCalls = 128;

/// Expressions and statements inside each other while they are evaluated, through calls and
/// instances: what the machine's stack holds.
inline constexpr int kMaxEvaluationDepth = 2000;

/// Steps of work: one is about 10 nanoseconds, what an operation on two numbers takes. What takes
/// longer counts as many steps as it takes of that time; `bench/hostile.py` shows whether it does.
namespace work {
inline constexpr std::uint64_t kStatement = 2, kProperty = 3, kTurn = 2;
inline constexpr std::uint64_t kCall = 8, kInstance = 80, kGroup = 15, kList = 8;
inline constexpr std::uint64_t kRotation = 400;     ///< of a group: six sines and cosines
inline constexpr std::uint64_t kSlot = 4;           ///< of the frame of a call
inline constexpr std::uint64_t kBytes = 16;         ///< bytes of a string that one step pays for
inline constexpr std::uint64_t kInclude = 500;      ///< beside the bytes of its file
inline constexpr std::uint64_t kIncludedByte = 2;   ///< of a file that is included again
inline constexpr std::uint64_t kSpheres = 100'000;  ///< spheres that double the limit
}  // namespace work

/// What one evaluation may use up. Each has a flag, `--limit NAME=N`, and an error of its own.
struct Limits {
  std::uint64_t steps = 100'000'000;                ///< of work: about a second
  std::uint64_t memory = std::uint64_t{1} << 30;    ///< bytes of all values and objects
  std::uint64_t objects = 100'000'000;              ///< spheres and instances
  std::uint64_t string = std::uint64_t{1} << 20;    ///< bytes of one string
  std::uint64_t include_depth = 32;                 ///< files inside files
  std::uint64_t file = std::uint64_t{32} << 20;     ///< bytes of one .scene file
  std::uint64_t config = std::uint64_t{256} << 20;  ///< bytes of one JSON config

  /// Of a file whose format is not known.
  constexpr std::uint64_t any_file() const noexcept { return file > config ? file : config; }
};

/// One row of the table of limits: its name in `--limit` and in messages.
struct LimitInfo {
  std::string_view name;
  std::uint64_t Limits::*limit;
  std::string_view doc;
};

inline constexpr std::array<LimitInfo, 7> kLimits{{
    {"steps", &Limits::steps,
     "steps of work of one evaluation, some 10 nanoseconds each: operations, calls, turns of "
     "loops, elements of lists, bytes of strings; each sphere allows a hundred-thousandth more"},
    {"memory", &Limits::memory,
     "bytes of all strings, lists, spheres and instances together; a sphere is 64"},
    {"objects", &Limits::objects, "spheres of a scene; an instance of many is 3"},
    {"string", &Limits::string, "bytes of one string"},
    {"include-depth", &Limits::include_depth, "files that import or include each other"},
    {"file", &Limits::file, "bytes of one .scene file"},
    {"config", &Limits::config, "bytes of one JSON config"},
}};

}  // namespace sdlc::lang
