#pragma once

#include <cstdint>
#include <vector>

#include "render/scene/scene.hpp"

namespace sdlc::render {

/// The emissive spheres for which diffuse surfaces look by themselves, by their indices, ascending.
/// LightSampling::On: all that shine and can be hit. Those of prototypes are never among them.
///
/// LightSampling::Auto goes by geometry alone, as a few paths traced would not know of the light
/// that they did not find. From places on diffuse surfaces that are near the camera, an emitter of
/// radius r and radiance L at the distance d takes the share F = (r/d)²/2 of what scatters, which
/// adds L²F(1 − F) to the variance of a path. Emitters with F of at most 1/4 can be sampled, and
/// they are, all of them, where together they have at least as much variance as remains, that of
/// the other emitters and the square of what arrives in all: a gradient of it, edges and
/// interreflection are of that order. Otherwise connections cost more time than they save.
std::vector<std::uint32_t> choose_lights(const Scene& scene, LightSampling sampling);

}  // namespace sdlc::render
