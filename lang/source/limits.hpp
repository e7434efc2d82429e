#pragma once

/// What no file may exceed, in one place.
namespace sdlc::lang {

/// Brackets inside brackets, in both formats. Whatever walks a tree recursively relies on it.
inline constexpr int kMaxNesting = 128;

}  // namespace sdlc::lang
