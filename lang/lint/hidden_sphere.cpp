#include "lang/lint/context.hpp"

namespace sdlc::lang {

/// Sphere a is wholly inside sphere b, and b's surface is not transmissive: |a − b| + radius of a
/// ≤ radius of b, less a margin for rounding, at both ends of the shutter, and so between them, the
/// distance of two centres that move straight being a convex function of the time. No path from a
/// camera outside of b gets into b. Spheres with a camera inside, or nearly, are no such b. Other
/// rules are silent about what is hidden.
void check_hidden_sphere(LintContext& context) {
  std::size_t findings = 0;
  for (const auto& [sphere, around] : context.hidden()) {
    const render::Sphere &inner = context.spheres()[sphere], &outer = context.spheres()[around];
    Finding& finding = context.add(diag::hidden_sphere, LintPlace::of_sphere(sphere));
    finding.labels.push_back({LintPlace::of_sphere(around), "inside this one"});
    finding.help.push_back(fmt::format(
        "the centres are {:.4g} apart; that and the radius {:.4g} are less than the radius {:.4g}",
        length(inner.center - outer.center), inner.radius, outer.radius));
    if (++findings == LintContext::kMostFindings) return;
  }
}

}  // namespace sdlc::lang
