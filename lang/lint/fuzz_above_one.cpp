#include "lang/lint/context.hpp"

namespace sdlc::lang {

/// A specular material has a fuzz above 1. The direction of a reflected ray is the unit mirror
/// direction plus `fuzz` times a random point of the unit ball; a ray whose direction points into
/// the surface is absorbed. With a fuzz of at most 1, no ray that arrives along the normal is
/// absorbed: the mirror direction points straight out of the surface, and its length is 1. With a
/// larger fuzz, some rays of every incoming direction are absorbed, so the surface is darker than
/// its colour everywhere.
void check_fuzz_above_one(LintContext& context) {
  for (const std::uint32_t sphere : context.spheres_of_materials()) {
    const render::Material& material = context.material_of(sphere);
    if (material.type != render::MaterialType::Specular || !(material.parameter > 1)) continue;
    Finding& finding = context.add(diag::fuzz_above_one, LintPlace::of_material(sphere),
                                   fmt::format("{:.6g}", material.parameter));
    finding.help.push_back("use a fuzz from 0 (a mirror) to 1 (the dullest metal), or `diffuse`");
  }
}

}  // namespace sdlc::lang
