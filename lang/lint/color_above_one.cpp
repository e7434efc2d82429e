#include <algorithm>

#include "lang/lint/context.hpp"
#include "lang/schema/schema.hpp"

namespace sdlc::lang {
namespace {

std::optional<MaterialKind> reflecting_kind(render::MaterialType type) {
  switch (type) {
    case render::MaterialType::Diffuse: return MaterialKind::Diffuse;
    case render::MaterialType::Specular: return MaterialKind::Specular;
    case render::MaterialType::Transmissive: return MaterialKind::Transmissive;
    default: return std::nullopt;
  }
}

}  // namespace

/// A component of the colour of a diffuse, specular or transmissive material is more than 1, by
/// more than rounding: the renderer multiplies radiance by it, so more light leaves the surface
/// than arrives. Between such surfaces light grows with each reflection, up to `depth`.
void check_color_above_one(LintContext& context) {
  constexpr double kMaxComponent = 1 + 1e-9;
  for (const std::uint32_t sphere : context.spheres_of_materials()) {
    const render::Material& material = context.material_of(sphere);
    const auto kind = reflecting_kind(material.type);
    const double largest = std::max({material.color.r, material.color.g, material.color.b});
    if (!kind || !(largest > kMaxComponent)) continue;
    Finding& finding = context.add(diag::color_above_one, LintPlace::of_material(sphere),
                                   material_info(*kind).name, fmt::format("{:.6g}", largest));
    const bool is_config = context.file().format() == SourceFormat::Json;
    finding.help.push_back(is_config ? "255 returns all of the light"
                                     : "`rgb(…)` takes 0 to 255, `linear(…)` 0 to 1; for a light "
                                       "use `emissive` or `unlit`");
  }
}

}  // namespace sdlc::lang
