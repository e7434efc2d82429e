#include "render/wide/wide_scene.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "render/scene/camera_surface.hpp"

namespace sdlc::render {
namespace {

template <typename T>
std::array<T, 3> rounded(LinearRgb c) {
  return {static_cast<T>(c.r), static_cast<T>(c.g), static_cast<T>(c.b)};
}

std::uint32_t surface_bits(const Material& material) {
  switch (material.type) {
    case MaterialType::Diffuse: return 0;
    case MaterialType::Specular: return material.parameter > 0 ? kMirrors | kIsFuzzy : kMirrors;
    case MaterialType::Transmissive:
      return material.fresnel == Fresnel::Exact ? kRefracts | kIsExact : kRefracts;
    default: return kEndsPath;
  }
}

/// The order of the tables.
std::vector<std::uint32_t> table_order(std::size_t spheres,
                                       std::span<const std::uint32_t> exact_spheres) {
  std::vector<std::uint32_t> order;
  for (std::uint32_t i = 0; i < spheres; ++i) {
    if (std::find(exact_spheres.begin(), exact_spheres.end(), i) == exact_spheres.end()) {
      order.push_back(i);
    }
  }
  order.insert(order.end(), exact_spheres.begin(), exact_spheres.end());
  return order;
}

}  // namespace

template <typename T>
WideScene<T>::WideScene(const Scene& scene, int depth,
                        std::span<const std::uint32_t> spheres_in_double)
    : spheres(scene.spheres.size()),
      exact_spheres(spheres_in_double.size()),
      max_depth(static_cast<std::uint32_t>(depth)),
      has_motion(!scene.shifts.empty()) {
  const std::vector<std::uint32_t> order = table_order(spheres, spheres_in_double);
  for (std::size_t i = 0; i < spheres; ++i) {
    const Sphere& sphere = scene.spheres[order[i]];
    const Vec3 moves = has_motion ? scene.shifts[order[i]] : Vec3{};
    for (const auto& [table, v] : {std::pair{&center, sphere.center}, {&shift, moves}}) {
      (*table)[0][i] = static_cast<T>(v.x);
      (*table)[1][i] = static_cast<T>(v.y);
      (*table)[2][i] = static_cast<T>(v.z);
    }
    radius[i] = static_cast<T>(sphere.radius);
    // The square of the radius that the kernel takes; a sphere of radius 0 is never hit.
    radius_squared[i] = sphere.radius > 0 ? radius[i] * radius[i] : T{-1};
    if (i >= spheres - exact_spheres) {
      exact[i - (spheres - exact_spheres)] = {
          .center = {sphere.center.x, sphere.center.y, sphere.center.z},
          .shift = {moves.x, moves.y, moves.z},
          .radius_squared = sphere.radius * sphere.radius};
    }
    if (has_camera_on_it(sphere, moves)) {
      camera_sphere = static_cast<std::uint32_t>(i);
      const Vec3 normal = unit(-sphere.center);
      camera_normal = {static_cast<T>(normal.x), static_cast<T>(normal.y),
                       static_cast<T>(normal.z)};
    }
    add_material(i, scene.materials[sphere.material]);
  }
  const LinearRgb bottom = scene.background.bottom, top = scene.background.top;
  // bottom at y = −1, top at y = 1; a constant sky stays exact.
  sky_middle = rounded<T>(scene.background.is_constant() ? bottom : (bottom + top) * 0.5);
  sky_slope = rounded<T>((top - bottom) * 0.5);
}

template <typename T>
void WideScene<T>::add_material(std::size_t i, const Material& material) {
  const bool is_emissive = material.type == MaterialType::Emissive;
  const Triple rgb = rounded<T>(is_emissive ? material.color * material.parameter : material.color);
  for (std::size_t c = 0; c < 3; ++c) color[c][i] = rgb[c];
  surface[i] = surface_bits(material);
  const double p = material.parameter;
  if (material.type == MaterialType::Specular) {
    first[i] = static_cast<T>(p > 1 ? 1 / p : 1);
    second[i] = static_cast<T>(std::min(p, 1.0));
  } else if (material.type == MaterialType::Transmissive) {
    has_exact_fresnel |= material.fresnel == Fresnel::Exact;
    const double root = (1 - p) / (1 + p);
    first[i] = static_cast<T>(p);
    second[i] = static_cast<T>(1 / p);
    straight[i] = static_cast<T>(root * root);
  }
}

template struct WideScene<float>;
template struct WideScene<double>;

}  // namespace sdlc::render
