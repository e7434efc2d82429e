#pragma once

/// What no file may exceed, in one place.
namespace sdlc::lang {

/// Brackets inside brackets, in both formats. Whatever walks a tree recursively relies on it.
inline constexpr int kMaxNesting = 128;

/// Calls inside calls of functions of the file's own.
inline constexpr int kMaxCalls = 128;

/// Expressions inside expressions while they are computed, through calls: what the machine's stack holds.
inline constexpr int kMaxEvaluationDepth = 2000;

/// Loop turns and calls in one file.
inline constexpr int kMaxSteps = 100000000;

}  // namespace sdlc::lang
