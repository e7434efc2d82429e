#include <algorithm>
#include <limits>

#include "lang/lint/context.hpp"

namespace sdlc::lang {

/// A group rotates while the shutter is open, so a sphere in it should move on an arc, but it moves
/// straight from its position at the opening to that at the closing. Half-way the error is the
/// sagitta of the arc, r (1 − cos(θ / 2)) for a radius r and an angle θ. Reported if it is more
/// than two pixels, at the distance of the sphere from the nearest camera. The true midpoint is
/// that of translations and angles half-way between those of the two ends.
void check_bent_path(LintContext& context) {
  constexpr double kMinPixels = 2;
  std::size_t findings = 0;
  for (const BentPath& path : context.lowered().bent_paths) {
    context.stop_if_requested();
    if (context.is_hidden(path.sphere)) continue;
    const render::Sphere& sphere = context.spheres()[path.sphere];
    double pixel = std::numeric_limits<double>::infinity();
    for (const CheckedCamera& camera : context.lowered().checked_cameras) {
      const double distance = length(camera.camera.from - sphere.center);
      pixel = std::min(pixel,
                       distance * camera.camera.plane_height / context.lowered().settings.height);
    }
    if (!(path.sagitta > kMinPixels * pixel)) continue;
    Finding& finding = context.add(diag::bent_path, LintPlace::of_sphere(path.sphere));
    finding.help.push_back(
        fmt::format("half-way the error is {:.4g}, or {:.3g} pixels; half the shutter time gives a "
                    "quarter of it",
                    path.sagitta, path.sagitta / pixel));
    if (++findings == LintContext::kMaxFindings) return;
  }
}

}  // namespace sdlc::lang
