#include <cmath>

#include "lang/lint/context.hpp"

namespace sdlc::lang {

/// Width, height and the camera's aspect are all given, and the height differs from width / aspect
/// by a row or more: the view plane is stretched over the picture, and a sphere at its centre
/// becomes an ellipse.
void check_uneven_pixels(LintContext& context) {
  const Location width = context.lowered().places.width, height = context.lowered().places.height;
  if (width.file == nullptr || height.file == nullptr) return;
  const render::RenderSettings& settings = context.lowered().settings;
  for (const CheckedCamera& camera : context.lowered().checked_cameras) {
    if (camera.aspect.file == nullptr) continue;
    const double fitting = settings.width / camera.camera.aspect;
    if (std::fabs(fitting - settings.height) < 1) continue;
    const double stretch = settings.height / fitting;
    Finding& finding =
        context.add(diag::uneven_pixels, LintPlace::of(camera.aspect), settings.width,
                    settings.height, fmt::format("{:.6g}", camera.camera.aspect));
    finding.labels.push_back({LintPlace::of(height), "the height"});
    finding.help.push_back(
        fmt::format("the picture is stretched: objects look {:.4g} times as {} as they are; the "
                    "default of `aspect` is width / height",
                    stretch > 1 ? stretch : 1 / stretch, stretch > 1 ? "tall" : "wide"));
    finding.fixes.push_back(
        {camera.aspect, fmt::format("{} / {}", settings.width, settings.height), false});
  }
}

}  // namespace sdlc::lang
