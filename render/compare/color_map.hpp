#pragma once

#include <span>

#include "render/image/picture.hpp"
#include "render/math/color.hpp"

namespace sdlc::render {

/// A colour for a share from 0 (nearly black) to 1 (nearly white), linear: a path through blue,
/// red and yellow along which equal steps look equally large, with lightness that only rises, so
/// that it reads in grey and for the colour-blind too. Shares beyond the ends have the end's.
LinearRgb mapped_color(double share) noexcept;

/// Each value as the colour of its share of `top`, row by row.
Picture color_mapped(std::span<const float> values, int width, int height, double top);

}  // namespace sdlc::render
