#include <vector>

#include "lang/lint/sphere_tree.hpp"

namespace sdlc::lang {

/// A transmissive sphere has an index of refraction below 1, and its centre is in no other
/// transmissive sphere. The index is relative to the surroundings, and no medium has a lower index
/// than air, so a value below 1 is for a bubble in glass or water.
void check_ior_below_one(LintContext& context) {
  std::vector<std::uint32_t> transmissive, bubbles;
  for (std::uint32_t i = 0; i < context.spheres().size(); ++i) {
    if (!context.is_transmissive(i)) continue;
    transmissive.push_back(i);
    if (context.material_of(i).parameter < 1 && !context.is_hidden(i)) bubbles.push_back(i);
  }
  if (bubbles.empty()) return;
  SphereTree tree(context, transmissive);
  std::size_t findings = 0;
  for (const std::uint32_t sphere : bubbles) {
    // Each sphere contains its own centre.
    if (tree.count_containing(context.spheres()[sphere].center) != 1) continue;
    const double ior = context.material_of(sphere).parameter;
    Finding& finding = context.add(diag::ior_below_one, LintPlace::of_material(sphere),
                                   fmt::format("{:.6g}", ior));
    finding.help.push_back(fmt::format(
        "the index is relative to the surroundings of the sphere; the inverse is {:.6g}", 1 / ior));
    if (++findings == LintContext::kMaxFindings) return;
  }
}

}  // namespace sdlc::lang
