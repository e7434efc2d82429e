#include "lang/lint/context.hpp"

namespace sdlc::lang {

/// A transmissive material has an index of refraction of 1 and uses Schlick's approximation of the
/// reflectance, R0 + (1 − R0) (1 − cos θ)⁵ with R0 = ((1 − ior) / (1 + ior))² = 0. A transmitted
/// ray is not refracted, but the share (1 − cos θ)⁵ of the light is reflected, all of it at the
/// rim. The exact Fresnel equations give 0, so `fresnel: exact` is excluded.
void check_ior_of_one(LintContext& context) {
  for (const std::uint32_t sphere : context.spheres_of_materials()) {
    const render::Material& material = context.material_of(sphere);
    const bool is_fine = material.type != render::MaterialType::Transmissive ||
                         material.parameter != 1 || material.fresnel != render::Fresnel::Schlick;
    if (is_fine) continue;
    Finding& finding = context.add(diag::ior_of_one, LintPlace::of_material(sphere));
    finding.help.push_back(
        "Schlick's approximation reflects (1 - cos θ)^5 of the light, all of it at the rim; "
        "`fresnel: exact` reflects nothing");
  }
}

}  // namespace sdlc::lang
