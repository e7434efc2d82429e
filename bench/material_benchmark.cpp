#include <string>
#include <utility>

#include "bench/benchmarks.hpp"
#include "bench/renders.hpp"

// The cost of a ray if all spheres, including the ground, have one material.
namespace sdlc::bench {

void register_material_benchmarks() {
  using render::Fresnel;
  using render::LinearRgb;
  using render::Material;
  using render::MaterialType;
  constexpr LinearRgb kColor{0.7, 0.6, 0.5};
  const std::pair<const char*, Material> materials[] = {
      {"diffuse", {.color = kColor}},
      {"mirror", {.color = kColor, .type = MaterialType::Specular}},
      {"fuzzy", {.color = kColor, .parameter = 0.3, .type = MaterialType::Specular}},
      {"glass", {.color = kColor, .parameter = 1.5, .type = MaterialType::Transmissive}},
      {"glass_exact",
       {.color = kColor,
        .parameter = 1.5,
        .type = MaterialType::Transmissive,
        .fresnel = Fresnel::Exact}},
      {"emissive", {.color = kColor, .parameter = 1, .type = MaterialType::Emissive}},
  };
  for (const auto& [name, material] : materials) {
    render::Scene scene = eight_on_ground();
    for (Material& each : scene.materials) each = material;
    for (const Form& form : forms()) {
      register_render("material/" + std::string(name), scene, form);
    }
  }
}

}  // namespace sdlc::bench
