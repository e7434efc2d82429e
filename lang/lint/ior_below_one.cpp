#include <vector>

#include "lang/lint/sphere_tree.hpp"

namespace sdlc::lang {

/// A transmissive sphere has an index of refraction below 1, and its centre is in no other
/// transmissive sphere. The index is relative to what is around: nothing is thinner than air, so a
/// value below 1 belongs to a bubble in glass or water, and there is none.
void check_ior_below_one(LintContext& context) {
  std::vector<std::uint32_t> transmissive, thin;
  for (std::uint32_t i = 0; i < context.spheres().size(); ++i) {
    if (!context.is_transmissive(i)) continue;
    transmissive.push_back(i);
    if (context.material_of(i).parameter < 1 && !context.is_hidden(i)) thin.push_back(i);
  }
  if (thin.empty()) return;
  SphereTree tree(context, transmissive);
  std::size_t findings = 0;
  for (const std::uint32_t sphere : thin) {
    // It is in itself.
    if (tree.count_around(context.spheres()[sphere].center) != 1) continue;
    const double ior = context.material_of(sphere).parameter;
    Finding& finding = context.add(diag::ior_below_one, LintPlace::of_material(sphere),
                                   fmt::format("{:.6g}", ior));
    finding.help.push_back(fmt::format(
        "the index is relative to what is around the sphere; that of the inverse is {:.6g}",
        1 / ior));
    if (++findings == LintContext::kMostFindings) return;
  }
}

}  // namespace sdlc::lang
