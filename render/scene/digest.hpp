#pragma once

#include <cstdint>

#include "render/scene/scene.hpp"

namespace sdlc::render {

/// The 64-bit FNV-1a hash of the bits of all numbers of the scene: equal for equal scenes, and the
/// same on every machine.
std::uint64_t digest_of(const Scene& scene);

}  // namespace sdlc::render
