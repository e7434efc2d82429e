#include "lang/lint/context.hpp"
#include "lang/lower/precision_fault.hpp"

namespace sdlc::lang {

/// The precision that `render` chooses, or double where it chooses none, is beyond its bounds as
/// one of the cameras sees the scene: the renderer's own bounds on rounding, measured on single
/// rays. That double does not resolve the scene's lengths at all is an error elsewhere. Spheres are
/// gone through once for each camera, of many spheres not for all cameras.
void check_beyond_precision(LintContext& context) {
  const LoweredScene& lowered = context.lowered();
  const auto& cameras = lowered.checked_cameras;
  const std::size_t count = cameras_to_judge(cameras.size(), context.spheres().size());
  for (std::size_t i = 0; i < count; ++i) {
    context.stop_if_requested();
    const auto fault = find_precision_fault(context.scene(), cameras[i].camera, lowered.settings,
                                            lowered.precision);
    if (!fault || fault->info != &diag::beyond_precision) continue;
    const bool is_written = lowered.places.precision.file != nullptr;
    LintPlace place = LintPlace::of(cameras[i].from);
    if (!fault->roles.empty()) place = LintPlace::of_sphere(fault->roles.front().sphere);
    if (is_written) place = LintPlace::of(lowered.places.precision);
    Finding& finding = context.add_finding(*fault->info, place, fault->message);
    for (std::size_t k = is_written ? 0 : 1; k < fault->roles.size(); ++k) {
      finding.labels.push_back(
          {LintPlace::of_sphere(fault->roles[k].sphere), fault->roles[k].label});
    }
    finding.help.push_back(fault->help);
    return;
  }
}

}  // namespace sdlc::lang
