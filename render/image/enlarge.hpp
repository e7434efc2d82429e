#pragma once

#include <vector>

#include "render/image/layer.hpp"
#include "render/image/picture.hpp"

namespace sdlc::render {

/// Each pixel as `factor` × `factor` pixels.
Picture enlarged(const Picture& picture, int factor);
/// The same for a channel of a picture with this width.
Layer enlarged(const Layer& layer, int width, int factor);

}  // namespace sdlc::render
