#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "render/scene/scene.hpp"

namespace sdlc::render {

/// Whether a scene can be traced in float without anything to be seen of it.
struct FloatVerdict {
  bool is_accepted = false;
  /// Accepted on condition that these spheres, the largest ones, are met in double; empty: all in
  /// float.
  std::vector<std::uint32_t> exact_spheres;
  std::string reason;  ///< what is refused, or why some spheres are exact; empty: nothing to say
};

/// Judges by bounds on what rounding does, measured on single rays (u = 2^-24, E the extent: the
/// distance from the camera to the far side of the farthest sphere, over the whole shutter). A
/// scene is accepted if the error of a hit, 25 u E, is at most a hundredth of the smallest radius;
/// the error across the view, 2 u E, at most a sixteenth of a pixel at the distance of each
/// surface; a pixel at least 16 u wide; every gap between two surfaces 0 or at least 2^-16 of the
/// larger radius. Up to `most_exact` spheres larger than all others may break this if distances to
/// them are computed in double; the rounding of points on them still counts. `height`: of the
/// picture, in pixels. O(n²) time.
FloatVerdict judge_float(const Scene& scene, int height, std::size_t most_exact);

}  // namespace sdlc::render
