#pragma once

#include <vector>

#include "render/image/layer.hpp"
#include "render/image/picture.hpp"

namespace sdlc::render {

/// Each pixel as `factor` × `factor` pixels.
Picture enlarged(const Picture& picture, int factor);
/// The same for a channel of a picture with this width.
Layer enlarged(const Layer& layer, int width, int factor);

/// Each pixel is the mean of the pixels that it covers (a box filter). Precondition: the size is at
/// least 1 and at most that of the picture.
Picture shrunk(const Picture& picture, int width, int height);

}  // namespace sdlc::render
