#pragma once

#include "render/exactness/lens_disc.hpp"
#include "render/exactness/rebase.hpp"
#include "render/scene/scene.hpp"

namespace sdlc::render {

/// The properties of a scene's instances that decide which precision resolves it; lengths in the
/// frame's unit. With a lens, distances are those from its worst point.
struct InstanceExtremes {
  double radius;    ///< of the smallest sphere; infinite without instances
  double extent;    ///< upper bound of the distance from the camera to the farthest far side
  double distance;  ///< lower bound of the distance from the camera to the nearest surface: outside
                    ///< the bounding spheres of instances, the distance to these; inside those of
                    ///< static instances, the distance to their spheres at shutter opening
};
/// O(instances + spheres of prototypes) time, plus the spheres of instances whose bounding sphere
/// contains the camera, at most about 10^7.
InstanceExtremes extremes_of_instances(const Scene& scene, const CameraFrame& frame,
                                       const LensDisc& lens = {});

/// Only InstanceExtremes::extent. O(instances + spheres of prototypes) time.
double extent_of_instances(const Scene& scene, const CameraFrame& frame);

}  // namespace sdlc::render
