#pragma once

#include <span>

#include "render/image/picture.hpp"
#include "render/math/color.hpp"

namespace sdlc::render {

/// Maps [0, 1] to linear colours from nearly black to nearly white, through blue, red and yellow.
/// Equal steps look equally large, and lightness rises monotonically, so the map also works in
/// greyscale and for colour-blind readers. Values outside [0, 1] are clamped.
LinearRgb mapped_color(double share) noexcept;

/// Maps each value divided by `top` to its colour; row by row.
Picture color_mapped(std::span<const float> values, int width, int height, double top);

}  // namespace sdlc::render
