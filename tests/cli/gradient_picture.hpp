#pragma once

#include "render/image/image.hpp"

namespace sdlc::test {

/// Smooth, with values from 0.1 to 0.9, different in each channel.
inline render::Picture gradient(int width = 12, int height = 8) {
  render::Picture picture(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double u = 0.1 + 0.8 * x / width, v = 0.1 + 0.8 * y / height;
      picture.at(x, y) = {u, v, 1 - u};
    }
  }
  return picture;
}

}  // namespace sdlc::test
