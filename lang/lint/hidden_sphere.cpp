#include "lang/lint/context.hpp"

namespace sdlc::lang {

/// Sphere a is completely inside an opaque sphere b: |a − b| + radius of a ≤ radius of b, minus a
/// margin for rounding, at both ends of the shutter. This holds in between too, because the
/// distance of two centres that move straight is a convex function of time. No path from a camera
/// outside of b reaches a. Spheres that contain a camera, or nearly, hide nothing. Other rules
/// ignore hidden spheres.
void check_hidden_sphere(LintContext& context) {
  std::size_t findings = 0;
  for (const auto& [sphere, container] : context.hidden()) {
    const render::Sphere &inner = context.spheres()[sphere], &outer = context.spheres()[container];
    Finding& finding = context.add(diag::hidden_sphere, LintPlace::of_sphere(sphere));
    finding.labels.push_back({LintPlace::of_sphere(container), "inside this one"});
    finding.help.push_back(fmt::format(
        "the centres are {:.4g} apart: that plus the radius {:.4g} is less than the radius {:.4g}",
        length(inner.center - outer.center), inner.radius, outer.radius));
    if (++findings == LintContext::kMaxFindings) return;
  }
}

}  // namespace sdlc::lang
