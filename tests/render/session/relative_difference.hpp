#pragma once

#include <cmath>
#include <cstddef>

#include "render/image/picture.hpp"

namespace sdlc::test {

/// The root mean square of the difference, divided by the mean of `b`.
inline double relative_difference(const render::Picture& a, const render::Picture& b) {
  double squares = 0, sum = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    const render::LinearRgb d = a.pixels[i] - b.pixels[i];
    squares += (d.r * d.r + d.g * d.g + d.b * d.b) / 3;
    sum += (b.pixels[i].r + b.pixels[i].g + b.pixels[i].b) / 3;
  }
  const auto pixels = static_cast<double>(a.pixels.size());
  return std::sqrt(squares / pixels) / (sum / pixels);
}

}  // namespace sdlc::test
