#include "lang/lint/sphere_tree.hpp"

namespace sdlc::lang {

/// At the opening of the shutter, the surfaces of two transmissive spheres with different indices
/// of refraction cross, |r1 − r2| < distance < r1 + r2, or touch from inside, distance = |r1 − r2|
/// up to rounding. The index in the common region is ambiguous: each surface refracts a ray by its
/// own index, independent of the medium on the other side, so a ray that enters both and leaves the
/// first is not refracted by the true ratio. Separate and nested spheres are well defined.
void check_crossing_surfaces(LintContext& context) {
  SphereTree tree(context, context.visible_transmissive());
  std::size_t findings = 0;
  for (const std::uint32_t sphere : tree.spheres()) {
    const auto crossing = tree.find_crossing(sphere);
    if (!crossing) continue;
    const render::Sphere &a = context.spheres()[sphere], &b = context.spheres()[crossing->sphere];
    Finding& finding = context.add(diag::crossing_surfaces, LintPlace::of_sphere(sphere),
                                   crossing->is_touch ? "touches from inside" : "crosses");
    finding.labels.push_back({LintPlace::of_sphere(crossing->sphere), "the other one"});
    finding.help.push_back(fmt::format(
        "the centres are {:.4g} apart, the radii {:.4g} and {:.4g}; the index of refraction in the "
        "common region is ambiguous: {:.4g} or {:.4g}",
        length(a.center - b.center), a.radius, b.radius, context.material_of(sphere).parameter,
        context.material_of(crossing->sphere).parameter));
    if (++findings == LintContext::kMaxFindings) return;
  }
}

}  // namespace sdlc::lang
