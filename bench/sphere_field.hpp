#pragma once

#include <string>

namespace sdlc::bench {

/// A slab four layers thick of `spheres` small spheres that do not touch: 70 % matt, 20 % metal,
/// 10 % glass, with numbers of the length that people's programs write. The same at every call.
std::string field_as_json(int spheres);

/// The same scene in the scene language, a sphere a line.
std::string field_as_scene(int spheres);

/// As many spheres from a loop, at random places.
std::string loop_as_scene(int spheres);

}  // namespace sdlc::bench
