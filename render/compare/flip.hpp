#pragma once

#include <vector>

#include "render/image/picture.hpp"

namespace sdlc::render {

/// LDR-ꟻLIP (Andersson et al., "ꟻLIP: A difference evaluator for alternating images", 2020): how
/// strongly somebody who flips between two pictures on a display sees a difference at a place.
struct FlipMap {
  int width = 0, height = 0;
  std::vector<float> values;  ///< one a pixel, row by row from the top: 0 not at all, 1 at most
  double mean = 0;            ///< of all pixels: the one number that stands for a pair of pictures
};

/// A 0.7 m wide display of 3840 pixels seen from 0.7 m, as in the paper.
inline constexpr double kFlipPixelsPerDegree = 67.0206;

/// Both pictures are linear radiance and as large as each other; values are cut off to [0, 1], as a
/// display does. On the threads of the arena that it runs in; the same bits whatever their number.
FlipMap flip(const Picture& picture, const Picture& reference,
             double pixels_per_degree = kFlipPixelsPerDegree);

}  // namespace sdlc::render
