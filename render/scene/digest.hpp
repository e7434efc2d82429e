#pragma once

#include <cstdint>

#include "render/scene/scene.hpp"

namespace sdlc::render {

/// The 64-bit FNV-1a hash of the bits of all numbers of a scene or of a part of it: equal for equal
/// scenes, and the same on every machine.
enum class Digest : std::uint64_t {};

/// Those of the parts of a scene.
struct SceneDigest {
  Digest spheres{};  ///< those of prototypes, instances and motion, too
  Digest materials{}, camera{}, background{};

  friend bool operator==(const SceneDigest&, const SceneDigest&) = default;
};

std::uint64_t digest_of(const Scene& scene);
SceneDigest digest_of_parts(const Scene& scene);

}  // namespace sdlc::render
