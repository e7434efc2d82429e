#include "lang/lint/context.hpp"

namespace sdlc::lang {

/// A specular material has a fuzz above 1. A reflected ray is the unit mirror direction plus fuzz
/// times a point of the unit ball, and is absorbed if that points inwards. Up to 1 no ray that hits
/// the surface head-on is absorbed, because the mirror direction is 1 away from the surface. Above
/// 1 some rays from each direction are, so the surface is darker than its colour everywhere.
void check_fuzz_above_one(LintContext& context) {
  for (const std::uint32_t sphere : context.spheres_of_materials()) {
    const render::Material& material = context.material_of(sphere);
    if (material.type != render::MaterialType::Specular || !(material.parameter > 1)) continue;
    Finding& finding = context.add(diag::fuzz_above_one, LintPlace::of_material(sphere),
                                   fmt::format("{:.6g}", material.parameter));
    finding.help.push_back("0 is a mirror and 1 the dullest metal; `diffuse` is duller");
  }
}

}  // namespace sdlc::lang
