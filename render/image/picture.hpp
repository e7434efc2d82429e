#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "render/math/color.hpp"

namespace sdlc::render {

/// The maximum size of a picture that is rendered, read or written, in pixels.
inline constexpr std::int64_t kMaxPicturePixels = std::int64_t{1} << 28;

/// A picture of linear RGB radiance: `width` × `height` pixels, row by row from the top, left to
/// right.
struct Picture {
  int width = 0;
  int height = 0;
  std::vector<LinearRgb> pixels;  ///< width · height elements

  Picture() = default;
  Picture(int w, int h, LinearRgb fill = LinearRgb{})
      : width(w),
        height(h),
        pixels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), fill) {}

  LinearRgb& at(int x, int y) noexcept {
    return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(x)];
  }
  const LinearRgb& at(int x, int y) const noexcept { return const_cast<Picture&>(*this).at(x, y); }
};

}  // namespace sdlc::render
