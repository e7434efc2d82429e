#include "lang/lint/context.hpp"

namespace sdlc::lang {

/// A transmissive material has an index of refraction of 1 and Schlick's approximation for its
/// reflectance, R0 + (1 − R0) (1 − cos θ)⁵ with R0 = ((1 − ior) / (1 + ior))² = 0: a ray that goes
/// through is not bent, and yet a part of (1 − cos θ)⁵ is reflected, all of it at the rim.
/// Fresnel's formula gives 0 there, so `fresnel: exact` is not meant.
void check_ior_of_one(LintContext& context) {
  for (const std::uint32_t sphere : context.spheres_of_materials()) {
    const render::Material& material = context.material_of(sphere);
    const bool is_meant = material.type != render::MaterialType::Transmissive ||
                          material.parameter != 1 || material.fresnel != render::Fresnel::Schlick;
    if (is_meant) continue;
    Finding& finding = context.add(diag::ior_of_one, LintPlace::of_material(sphere));
    finding.help.push_back(
        "by Schlick's approximation (1 - cos θ)^5 of the light is reflected, all of it at the rim; "
        "`fresnel: exact` reflects nothing");
  }
}

}  // namespace sdlc::lang
