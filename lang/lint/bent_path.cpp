#include <algorithm>
#include <limits>

#include "lang/lint/context.hpp"

namespace sdlc::lang {

/// Groups turn while the shutter is open, and the centre of a sphere in them, which goes straight
/// from where it is at the opening to where it is at the closing, misses the middle of its way by
/// more than two pixels of the nearest camera. On an arc of radius r and angle θ that is the
/// sagitta, r (1 − cos(θ / 2)). The true middle is that of translations and angles half-way between
/// those of the two ends. A pixel is as large as it is at the distance of the sphere's centre.
void check_bent_path(LintContext& context) {
  constexpr double kPixels = 2;
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
    if (!(path.sagitta > kPixels * pixel)) continue;
    Finding& finding = context.add(diag::bent_path, LintPlace::of_sphere(path.sphere));
    finding.help.push_back(fmt::format(
        "half-way it is {:.4g} from where it should be, or {:.3g} pixels; a shorter shutter makes "
        "that less, half of it a quarter",
        path.sagitta, path.sagitta / pixel));
    if (++findings == LintContext::kMostFindings) return;
  }
}

}  // namespace sdlc::lang
