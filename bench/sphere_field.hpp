#pragma once

#include <string>

namespace sdlc::bench {

/// A slab, four layers thick, of `spheres` small spheres that do not touch: 70 % matt, 20 % metal,
/// 10 % glass, with as many digits as programs usually write. Deterministic.
std::string field_as_json(int spheres);

/// The same scene in the scene language, one sphere per line.
std::string field_as_scene(int spheres);

/// The same number of spheres from a loop, at random places.
std::string loop_as_scene(int spheres);

/// Lists of the centres and radii of that loop, and a sphere for the last of them.
std::string comprehension_as_scene(int spheres);

/// A loop over the rows of `field.csv`, and that file: the centres and radii of as many spheres.
std::string data_as_scene();
std::string field_as_csv(int spheres);

}  // namespace sdlc::bench
