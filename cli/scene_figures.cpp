#include "cli/scene_figures.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "render/math/color.hpp"
#include "render/scene/bounding_sphere.hpp"
#include "render/scene/instances.hpp"

namespace sdlc::cli {
namespace {

using render::Vec3;

Vec3 lower_corner(Vec3 a, Vec3 b) {
  return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
}
Vec3 upper_corner(Vec3 a, Vec3 b) {
  return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
}

/// The figures that all instances of a prototype share.
struct PrototypeFigures {
  double smallest = std::numeric_limits<double>::infinity(), largest = 0;  // radii
  std::uint64_t spheres = 0, moving = 0;
  render::BoundingSphere ball;
};

PrototypeFigures measure_prototype(const render::Prototype& prototype) {
  PrototypeFigures figures;
  figures.ball = bounding_sphere(prototype);
  figures.spheres = prototype.spheres.size();
  for (const render::Sphere& sphere : prototype.spheres) {
    figures.smallest = std::min(figures.smallest, sphere.radius);
    figures.largest = std::max(figures.largest, sphere.radius);
  }
  for (const Vec3 shift : prototype.shifts) figures.moving += shift != Vec3{} ? 1 : 0;
  return figures;
}

/// Adds the figures of instances; `add(center, radius)` extends bounds and extent.
template <typename Add>
void measure_instances(const render::Scene& scene, const Add& add, SphereFigures& figures) {
  std::vector<PrototypeFigures> prototypes;
  for (const render::Prototype& prototype : scene.prototypes) {
    prototypes.push_back(measure_prototype(prototype));
  }
  for (const render::Instance& instance : scene.instances) {
    const PrototypeFigures& prototype = prototypes[instance.prototype];
    const double scale = instance.placement.scale;
    const Vec3 center = instance.placement.apply(prototype.ball.center);
    for (const Vec3 place : {center, center + instance.shift}) {
      add(place, prototype.ball.radius * scale);
    }
    if (prototype.smallest * scale < figures.smallest.radius) {
      figures.smallest = {.sphere = {}, .radius = prototype.smallest * scale};
    }
    if (prototype.largest * scale > figures.largest.radius) {
      figures.largest = {.sphere = {}, .radius = prototype.largest * scale};
    }
    figures.moving += instance.shift != Vec3{} ? prototype.spheres : prototype.moving;
  }
}

std::size_t instance_bytes(const render::Scene& scene) {
  std::size_t bytes = scene.instances.size() * sizeof(render::Instance);
  for (const render::Prototype& prototype : scene.prototypes) {
    bytes +=
        prototype.spheres.size() * sizeof(render::Sphere) + prototype.shifts.size() * sizeof(Vec3);
  }
  return bytes;
}

}  // namespace

std::string_view material_name(render::MaterialType type) noexcept {
  switch (type) {
    case render::MaterialType::Diffuse: return "diffuse";
    case render::MaterialType::Specular: return "specular";
    case render::MaterialType::Transmissive: return "transmissive";
    case render::MaterialType::Emissive: return "emissive";
    case render::MaterialType::Unlit: break;
  }
  return "unlit";
}

MaterialCounts count_materials(const render::Scene& scene) {
  using render::MaterialType;
  MaterialCounts counts{{{MaterialType::Diffuse},
                         {MaterialType::Specular},
                         {MaterialType::Transmissive},
                         {MaterialType::Emissive},
                         {MaterialType::Unlit}}};
  std::vector<std::uint64_t> spheres_of(scene.materials.size());
  for (const render::Sphere& sphere : scene.spheres) ++spheres_of[sphere.material];
  std::vector<std::uint64_t> uses(scene.prototypes.size());
  for (const render::Instance& instance : scene.instances) ++uses[instance.prototype];
  for (std::size_t i = 0; i < uses.size(); ++i) {
    for (const render::Sphere& sphere : scene.prototypes[i].spheres) {
      spheres_of[sphere.material] += uses[i];
    }
  }
  for (std::size_t i = 0; i < spheres_of.size(); ++i) {
    if (spheres_of[i] == 0) continue;  // its spheres were dropped
    const auto row = std::ranges::find(counts, scene.materials[i].type, &MaterialFigures::type);
    ++row->materials;
    row->spheres += spheres_of[i];
  }
  return counts;
}

std::vector<std::string> required_features(const render::Scene& scene,
                                           const MaterialCounts& materials) {
  std::vector<std::string> features;
  if (has_motion(scene)) features.emplace_back("motion");
  if (scene.camera.has_lens()) features.emplace_back("lens");
  if (!scene.background.is_constant()) features.emplace_back("gradient");
  for (const MaterialFigures& row : materials) {
    if (row.spheres > 0) features.emplace_back(material_name(row.type));
  }
  return features;
}

std::optional<SphereFigures> measure_spheres(const render::Scene& scene) {
  if (scene.spheres.empty() && scene.instances.empty()) return std::nullopt;
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  SphereFigures figures{.low = {kInfinity, kInfinity, kInfinity},
                        .high = {-kInfinity, -kInfinity, -kInfinity},
                        .smallest = {.sphere = {}, .radius = kInfinity},
                        .largest = {}};
  const auto add = [&](Vec3 center, double radius) {
    const Vec3 reach{radius, radius, radius};
    figures.low = lower_corner(figures.low, center - reach);
    figures.high = upper_corner(figures.high, center + reach);
    const Vec3 to_center = center - scene.camera.from;
    figures.extent =
        std::max(figures.extent, std::hypot(to_center.x, to_center.y, to_center.z) + radius);
  };
  for (std::uint32_t i = 0; i < scene.spheres.size(); ++i) {
    const auto& [center, radius, material] = scene.spheres[i];
    add(center, radius);
    if (radius < figures.smallest.radius) figures.smallest = {.sphere = i, .radius = radius};
    if (radius > figures.largest.radius) figures.largest = {.sphere = i, .radius = radius};
    if (scene.shifts.empty() || scene.shifts[i] == Vec3{}) continue;
    add(center + scene.shifts[i], radius);
    ++figures.moving;
  }
  measure_instances(scene, add, figures);
  return figures;
}

MemoryFigures estimate_memory(const render::Scene& scene, const render::RenderSettings& settings,
                              const render::Kernel& kernel) {
  return {.spheres = scene.spheres.size() * sizeof(render::Sphere),
          .motion = scene.shifts.size() * sizeof(Vec3),
          .instances = instance_bytes(scene),
          .materials = scene.materials.size() * sizeof(render::Material),
          .bvh = estimated_bytes(kernel, scene),
          .picture = static_cast<std::size_t>(settings.width) *
                     static_cast<std::size_t>(settings.height) * sizeof(render::LinearRgb)};
}

}  // namespace sdlc::cli
