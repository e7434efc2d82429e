#include <algorithm>

#include <fmt/format.h>

#include "lang/lint/context.hpp"
#include "render/exactness/lens_contact.hpp"

namespace sdlc::lang {

/// The diameter of the lens is larger than the distance from the lens to the nearest surface: what
/// is so near is blurred beyond recognition, and a value in another unit is likely (5 for 5mm). A
/// lens that touches a surface is an error (E241), and not reported here. Checks at most
/// kMaxCameras cameras.
void check_lens_too_large(LintContext& context) {
  const auto& cameras = context.lowered().checked_cameras;
  for (std::size_t k = 0; k < std::min(cameras.size(), LintContext::kMaxCameras); ++k) {
    const CheckedCamera& checked = cameras[k];
    if (!checked.camera.has_lens()) continue;
    context.stop_if_requested();
    const auto nearest =
        render::find_nearest_to_lens(context.scene(), checked.camera, checked.camera.aperture);
    if (!nearest || nearest->distance <= 0) continue;
    Finding& finding = context.add(diag::lens_too_large, LintPlace::of(checked.aperture),
                                   fmt::format("{:.4g}", nearest->distance));
    if (nearest->sphere) {
      finding.labels.push_back({LintPlace::of_sphere(*nearest->sphere), "this surface"});
    }
    finding.help.push_back("`aperture` is the diameter of the lens; `5mm` is 0.005");
  }
}

}  // namespace sdlc::lang
