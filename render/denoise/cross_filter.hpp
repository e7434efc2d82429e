#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "render/film/pixel_run.hpp"

namespace sdlc::render {

/// The means of a picture's replicates and the features of its first surfaces, in planes of 32-bit
/// floats, row by row.
struct ReplicatePlanes {
  int width = 0, height = 0;
  std::array<std::array<std::vector<float>, 3>, kReplicates> means;  ///< by replicate and channel
  /// Normal and albedo. They must not depend on the samples of the replicates.
  std::array<std::vector<float>, 6> features;

  std::size_t index(int x, int y) const noexcept {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(x);
  }
};

/// A pixel after the filter.
struct FilteredPixel {
  /// For each replicate, the value that the filter makes of the other ones.
  std::array<std::array<float, 3>, kReplicates> without{};
  float own_weight = 0;  ///< w_pp, where w_pq is the weight of the pixel q in the mean for p
  /// s_p², the variance of one replicate, summed over channels, as a mean over the pixels around p.
  float variance = 0;
  float filtered_variance = 0;  ///< Σ w_pq² s_q²
};

/// The pixels [x0, x1) × [y0, y1), at most kFilterTile wide and high.
struct TileArea {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};
inline constexpr int kFilterTile = 32;

/// Filters the pixels of an area, row by row, by non-local means (Buades, Coll and Morel, "A
/// non-local algorithm for image denoising", 2005): a pixel becomes the mean of those around it
/// whose own surroundings look the same. How much two surroundings may differ follows from their
/// variance (Rousselle, Knaus and Zwicker, "Adaptive rendering with non-local means filtering",
/// 2012). The weights for a replicate come from two others: the noise that decides on weights is
/// then independent of the noise that is averaged. The bits are the same on all processors.
using CrossFilter = std::vector<FilteredPixel>(const ReplicatePlanes& planes, const TileArea& area);

/// For every machine. Backend::filter is the same for its instruction set.
CrossFilter portable_filter;

}  // namespace sdlc::render
