#pragma once

#include <cstddef>

namespace sdlc::render {

/// A rectangle of pixels; (x, y) is its top left corner.
struct PixelWindow {
  int x = 0, y = 0, width = 0, height = 0;

  std::size_t pixels() const noexcept {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  }
  friend bool operator==(const PixelWindow&, const PixelWindow&) = default;
};

}  // namespace sdlc::render
