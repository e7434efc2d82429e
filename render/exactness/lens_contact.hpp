#pragma once

#include <cstdint>
#include <optional>

#include "render/scene/scene.hpp"

namespace sdlc::render {

/// A sphere whose surface meets the lens of a camera while the shutter is open. Rays that start on
/// both sides of a surface have no common first medium, so such a lens is refused.
struct LensContact {
  std::optional<std::uint32_t> sphere;  ///< index in the scene; nullopt: a sphere of an instance
};

/// The first sphere that the lens of `camera` meets; nullopt if there is none or no lens. A lens
/// that is entirely inside a sphere is fine. O(n) time.
std::optional<LensContact> find_lens_contact(const Scene& scene, const Camera& camera);

/// The nearest surface of the scene's spheres to the lens of `camera`, without instances.
struct NearestToLens {
  std::uint32_t sphere = 0;
  double distance = 0;  ///< from the nearest point of the disc, while the shutter is open
};
/// nullopt without spheres. O(n) time.
std::optional<NearestToLens> find_nearest_to_lens(const Scene& scene, const Camera& camera);

}  // namespace sdlc::render
