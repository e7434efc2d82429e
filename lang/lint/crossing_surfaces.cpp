#include <vector>

#include "lang/lint/sphere_tree.hpp"

namespace sdlc::lang {

/// The surfaces of two transmissive spheres cross, |r1 − r2| < distance < r1 + r2, or touch from
/// inside, distance = |r1 − r2| up to rounding, at the opening of the shutter, and their indices of
/// refraction differ. What is in both has no one index: each surface bends a ray by its own,
/// whatever is on the other side, so that a ray that enters one, then the other, and leaves the
/// first is bent by neither's true ratio. Spheres beside each other or one deep inside the other
/// are well defined.
void check_crossing_surfaces(LintContext& context) {
  std::vector<std::uint32_t> members;
  for (std::uint32_t i = 0; i < context.spheres().size(); ++i) {
    if (context.is_transmissive(i) && !context.is_hidden(i)) members.push_back(i);
  }
  SphereTree tree(context, members);
  std::size_t findings = 0;
  for (const std::uint32_t member : tree.members()) {
    const auto crossing = tree.find_crossing(member);
    if (!crossing) continue;
    const render::Sphere &a = context.spheres()[member], &b = context.spheres()[crossing->sphere];
    Finding& finding = context.add(diag::crossing_surfaces, LintPlace::of_sphere(member),
                                   crossing->is_touch ? "touches from inside" : "crosses");
    finding.labels.push_back({LintPlace::of_sphere(crossing->sphere), "the other one"});
    finding.help.push_back(fmt::format(
        "the centres are {:.4g} apart, the radii {:.4g} and {:.4g}: whether the index of "
        "refraction in both at once is {:.4g} or {:.4g} is not defined",
        length(a.center - b.center), a.radius, b.radius, context.material_of(member).parameter,
        context.material_of(crossing->sphere).parameter));
    if (++findings == LintContext::kMostFindings) return;
  }
}

}  // namespace sdlc::lang
