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
/// that is entirely inside a sphere is fine. O(spheres + instances + spheres of prototypes) time,
/// plus all spheres of every instance whose bounding sphere meets the lens.
std::optional<LensContact> find_lens_contact(const Scene& scene, const Camera& camera);

/// A surface near the lens of a camera.
struct NearestToLens {
  std::optional<std::uint32_t> sphere;  ///< as in LensContact
  double distance = 0;  ///< from the nearest point of the disc, while the shutter is open
};
/// The nearest surface to the lens of `camera`; nullopt if none is nearer than `within`. The same
/// time as find_lens_contact(), with the instances whose bounding sphere is nearer than `within`.
std::optional<NearestToLens> find_nearest_to_lens(const Scene& scene, const Camera& camera,
                                                  double within);

}  // namespace sdlc::render
