#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace sdlc::render {

/// A channel of a picture file in addition to red, green and blue.
struct Layer {
  std::string name;           ///< as in the file: "Z", "normal.X"
  std::vector<float> values;  ///< one per pixel, row by row from the top
};

/// The nearest 32-bit float; finite numbers beyond the largest float are clamped to it.
inline float to_float(double v) noexcept {
  constexpr double kLargest = std::numeric_limits<float>::max();
  return static_cast<float>(!std::isfinite(v) ? v : std::clamp(v, -kLargest, kLargest));
}

}  // namespace sdlc::render
