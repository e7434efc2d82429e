#pragma once

#include <optional>
#include <vector>

#include "render/kernel/path_kernel.hpp"

namespace sdlc::render {

struct Rectangle {
  double left, right, bottom, top;
};

/// A rectangle in the unit square that contains the part of an outline in it; nullopt if there is
/// none. A little larger, because the edges of the outline are curved.
std::optional<Rectangle> part_in_pixel(std::vector<Glint::Place> outline);

}  // namespace sdlc::render
