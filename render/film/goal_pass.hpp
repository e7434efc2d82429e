#pragma once

#include <cstdint>

namespace sdlc::render {

/// What a pass of a render with an error goal has found; the goal is decided by several.
struct GoalPass {
  std::uint64_t samples;      ///< per pixel
  double from, to, estimate;  ///< squares of the relative error's interval and of its estimate
  std::uint64_t is_blind;  ///< 1 if rare kinds of path may have hidden the error (no bool: padding)
};

}  // namespace sdlc::render
