#include "lang/convert/material_names.hpp"

#include <algorithm>
#include <limits>
#include <string_view>
#include <vector>

#include "lang/math/elementary.hpp"
#include "lang/value/colors.hpp"
#include "render/math/color.hpp"
#include "render/math/vec3.hpp"

namespace sdlc::lang {
namespace {

/// Oklab (Ottosson 2020), a perceptually uniform colour space: lightness and two axes of chroma.
/// The roots are those of lang/math, so that names are the same on every machine.
render::Vec3 to_oklab(render::LinearRgb c) noexcept {
  const auto root = [](double x) { return x > 0 ? power(x, 1.0 / 3) : 0.0; };
  const double l = root(0.4122214708 * c.r + 0.5363325363 * c.g + 0.0514459929 * c.b);
  const double m = root(0.2119034982 * c.r + 0.6806995451 * c.g + 0.1073969566 * c.b);
  const double s = root(0.0883024619 * c.r + 0.2817188376 * c.g + 0.6299787005 * c.b);
  return {0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s,
          1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s,
          0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s};
}

struct KnownColor {
  std::string_view name;
  render::Vec3 oklab;
};

const std::vector<KnownColor>& known_colors() {
  static const std::vector<KnownColor> colors = [] {
    std::vector<KnownColor> all;
    for (const NamedColor& color : named_colors()) {
      // Skip synonyms.
      if (color.name == "aqua" || color.name == "fuchsia") continue;
      if (color.name.find("grey") != std::string_view::npos) continue;
      all.push_back({color.name, to_oklab(*find_named_color(color.name))});
    }
    return all;
  }();
  return colors;
}

/// A colour brighter than white is named after its hue.
render::LinearRgb at_most_white(render::LinearRgb color) noexcept {
  const double largest = std::max({color.r, color.g, color.b});
  return largest > 1 ? color / largest : color;
}

std::string_view nearest_color(render::LinearRgb color) {
  const render::Vec3 wanted = to_oklab(at_most_white(color));
  std::string_view nearest;
  double smallest = std::numeric_limits<double>::infinity();
  for (const KnownColor& known : known_colors()) {
    const render::Vec3 way = known.oklab - wanted;
    const double distance = dot(way, way);
    if (distance >= smallest) continue;
    smallest = distance;
    nearest = known.name;
  }
  return nearest;
}

bool is_nearly_white(render::LinearRgb color) noexcept {
  const render::Vec3 way = to_oklab(at_most_white(color)) - render::Vec3{1, 0, 0};
  return dot(way, way) < 0.06 * 0.06;
}

std::string_view clear_substance(double ior) noexcept {
  if (ior < 1) return "bubble";
  if (ior >= 1.32 && ior <= 1.34) return "water";
  if (ior >= 2.4 && ior <= 2.43) return "diamond";
  return "glass";
}

}  // namespace

std::string describing_name(const MaterialValue& material) {
  const auto with_color = [&](std::string_view what) {
    return std::string(nearest_color(material.color)) + "_" + std::string(what);
  };
  const auto clear_or_colored = [&](std::string_view what) {
    return is_nearly_white(material.color) ? std::string(what) : with_color(what);
  };
  switch (material.kind) {
    case MaterialKind::Diffuse: return with_color("matt");
    case MaterialKind::Specular:
      return material.parameter == 0 ? clear_or_colored("mirror") : with_color("metal");
    case MaterialKind::Transmissive: return clear_or_colored(clear_substance(material.parameter));
    case MaterialKind::Emissive: return with_color("light");
    case MaterialKind::Unlit: return with_color("unlit");
  }
  return "material";
}

std::string MaterialNames::name_of(const MaterialValue& material) {
  const std::string name = describing_name(material);
  const int use = ++uses_[name];
  return use == 1 ? name : name + "_" + std::to_string(use);
}

}  // namespace sdlc::lang
