#pragma once

#include "render/scene/scene.hpp"

namespace sdlc::render {

/// Moves the scene so that the camera stands at the origin and scales it by a power of two so that
/// its extent E = max(|centre| + radius), over both ends of the shutter, lies in [1, 2). The
/// picture stays the same, bit for bit under scaling by powers of two, and no longer depends on
/// where in the world the scene is; squares of lengths can neither overflow nor vanish. Afterwards
/// camera.at − camera.from is only a direction.
void rebase_to_camera(Scene& scene);

}  // namespace sdlc::render
