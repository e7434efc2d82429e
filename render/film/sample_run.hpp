#pragma once

#include <cstdint>

#include "render/math/color.hpp"

namespace sdlc::render {

/// Consecutive samples of one replicate of one pixel, in one block of its SampleSum: what one lane,
/// or one call, traces from the first to the last.
struct SampleRun {
  std::uint64_t pixel = 0;  ///< row by row from the top left of the picture
  std::uint32_t replicate = 0;
  std::uint32_t first = 0;  ///< index of the first sample in the replicate
  std::uint32_t count = 0;
  LinearRgb sum;  ///< of the block so far; after tracing, with these samples
};

}  // namespace sdlc::render
