#include <algorithm>

#include "lang/lint/context.hpp"

namespace sdlc::lang {
namespace {

bool emits(const render::Material& material) {
  switch (material.type) {
    case render::MaterialType::Emissive: return !is_black(material.color * material.parameter);
    case render::MaterialType::Unlit: return !is_black(material.color);
    default: return false;
  }
}

}  // namespace

/// The background is black, and no sphere is `emissive` or `unlit` with a colour and an intensity
/// above 0. There is no other light, so every pixel is black.
void check_nothing_emits(LintContext& context) {
  const render::Background& background = context.scene().background;
  if (context.is_part() || !is_black(background.bottom) || !is_black(background.top)) return;
  const bool has_light = std::ranges::any_of(context.spheres(), [&](const render::Sphere& sphere) {
    return emits(context.scene().materials[sphere.material]);
  });
  if (has_light) return;
  Finding& finding =
      context.add(diag::nothing_emits, LintPlace::of(context.lowered().places.background));
  finding.help.push_back(
      "set a background colour, or give a sphere a material such as `emissive(color: white, "
      "intensity: 4)`");
}

}  // namespace sdlc::lang
