#pragma once

#include <array>
#include <cstdint>

#include "render/film/first_hits.hpp"
#include "render/math/color.hpp"

namespace sdlc::render {

/// The number of replicates of a picture: its samples are split into this many parts that are
/// scrambled independently. The differences between the parts give an estimate of the error.
inline constexpr std::uint32_t kReplicates = 4;

/// Samples of one pixel: of each replicate some consecutive ones, all within one block of its
/// SampleSum. One lane, or one call, traces them in order.
struct PixelRun {
  struct Part {
    std::uint32_t first = 0;  ///< index of the first sample in the replicate
    std::uint32_t count = 0;
    LinearRgb sum;  ///< sum of the block before tracing; afterwards with these samples included
  };

  std::uint64_t pixel = 0;  ///< row by row from the top left of the picture
  std::array<Part, kReplicates> parts{};
  FirstHitSums* first_hits = nullptr;  ///< to which those of the samples are added; may be null

  std::uint64_t samples() const noexcept {
    return std::uint64_t{parts[0].count} + parts[1].count + parts[2].count + parts[3].count;
  }
};

}  // namespace sdlc::render
