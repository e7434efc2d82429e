#pragma once

#include <cstdint>

#include "render/math/color.hpp"

namespace sdlc::render {

/// Consecutive samples of one replicate of one pixel, within one block of its SampleSum. One lane,
/// or one call, traces all of them in order.
struct SampleRun {
  std::uint64_t pixel = 0;  ///< row by row from the top left of the picture
  std::uint32_t replicate = 0;
  std::uint32_t first = 0;  ///< index of the first sample in the replicate
  std::uint32_t count = 0;
  LinearRgb sum;  ///< sum of the block before tracing; afterwards with these samples included
};

}  // namespace sdlc::render
