#pragma once

#include <vector>

#include "render/image/picture.hpp"

namespace sdlc::render {

/// LDR-ꟻLIP (Andersson et al., "ꟻLIP: A difference evaluator for alternating images", 2020): how
/// strongly a person who flips between two pictures on a display sees a difference, per pixel.
struct FlipMap {
  int width = 0, height = 0;
  std::vector<float> values;  ///< one per pixel, row by row from the top; from 0 (invisible) to 1
                              ///< (maximal)
  double mean = 0;            ///< over all pixels: the single-number score of a pair of pictures
};

/// A 0.7 m wide display of 3840 pixels, seen from 0.7 m, as in the paper.
inline constexpr double kFlipPixelsPerDegree = 67.0206;

/// Both pictures hold linear radiance and have the same size; values are clamped to [0, 1], as a
/// display does. Runs on the threads of the caller; the result does not depend on their
/// number.
FlipMap flip(const Picture& picture, const Picture& reference,
             double pixels_per_degree = kFlipPixelsPerDegree);

}  // namespace sdlc::render
