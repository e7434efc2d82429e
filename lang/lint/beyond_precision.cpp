#include "lang/lint/context.hpp"
#include "lang/lower/precision_fault.hpp"

namespace sdlc::lang {

/// As seen from one of the cameras, the scene exceeds the renderer's bounds on rounding errors for
/// the precision that `render` chooses, or for double if it chooses none. A scene whose scales are
/// too far apart for double is an error (E314), and not reported here. Each camera takes a pass
/// over the spheres, so scenes of many spheres are checked for the first cameras only.
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
