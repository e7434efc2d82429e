#pragma once

#include <cstdint>

#include "render/scene/scene.hpp"

namespace sdlc::render {

/// FNV-1a, 64 bits, over the bits of all numbers of the scene: equal for equal scenes, and the same
/// on every machine.
std::uint64_t digest_of(const Scene& scene);

}  // namespace sdlc::render
