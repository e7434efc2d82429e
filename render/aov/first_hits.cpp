#include "render/aov/first_hits.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "render/scene/camera_surface.hpp"
#include "render/sphere/intersect.hpp"

namespace sdlc::render {
namespace {

/// The colour of a surface independent of its lighting; for an emitter its light. Clamped to 1, the
/// maximum that Open Image Denoise accepts.
LinearRgb albedo_of(const Material& material) noexcept {
  const LinearRgb color = material.type == MaterialType::Emissive
                              ? material.color * material.parameter
                              : material.color;
  return {std::min(color.r, 1.0), std::min(color.g, 1.0), std::min(color.b, 1.0)};
}

}  // namespace

FirstHits::FirstHits(Scene scene)
    : pinhole_(scene.camera),
      forward_(pinhole_.place(0.5, 0.5)),
      has_motion_(!scene.shifts.empty()),
      rebase_(scene) {
  rebase_to_camera(scene);
  take_camera_surfaces(scene);
  bvh_ = Bvh(scene.spheres, scene.shifts);
  albedos_.reserve(bvh_.size());
  for (std::uint32_t slot = 0; slot < bvh_.size(); ++slot) {
    const Sphere& sphere = scene.spheres[bvh_.index_in_scene(slot)];
    albedos_.push_back(albedo_of(scene.materials[sphere.material]));
  }
}

void FirstHits::take_camera_surfaces(Scene& scene) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < scene.spheres.size(); ++i) {
    const Sphere sphere = scene.spheres[i];
    const Vec3 shift = has_motion_ ? scene.shifts[i] : Vec3{};
    if (has_camera_on_it(sphere, shift)) {
      camera_surfaces_.push_back({.normal = unit(-sphere.center),
                                  .radius = sphere.radius,
                                  .albedo = albedo_of(scene.materials[sphere.material])});
      continue;
    }
    scene.spheres[kept] = sphere;
    if (has_motion_) scene.shifts[kept] = shift;
    ++kept;
  }
  scene.spheres.resize(kept);
  if (has_motion_) scene.shifts.resize(kept);
}

template <bool kMoving>
FirstHit FirstHits::trace(const Ray& ray) const noexcept {
  const BvhHit hit = bvh_.intersect<kMoving>(ray, {});
  double t = hit.t;
  Vec3 outward;
  LinearRgb albedo;
  if (hit.sphere != kNoSphere) {
    const Vec3 center = bvh_.center<kMoving>(hit.sphere, ray.u);
    outward = unit((ray.origin - center) + ray.direction * t);
    albedo = albedos_[hit.sphere];
  }
  for (const CameraSurface& surface : camera_surfaces_) {
    const double again = rehit_distance(ray.direction, surface.normal, surface.radius);
    if (again >= t) continue;
    t = again;
    outward = rehit_normal(ray.direction, surface.normal);
    albedo = surface.albedo;
  }
  if (t == kNoHit) return {};
  return {.is_hit = true,
          .normal = dot(ray.direction, outward) > 0 ? -outward : outward,
          .depth = t * dot(ray.direction, forward_),
          .albedo = albedo};
}

FirstHit FirstHits::trace(double s, double t, const PathSampler& sampler) const noexcept {
  Ray ray{.origin = {}, .direction = pinhole_.direction(s, t)};
  if (!has_motion_) return trace<false>(ray);
  ray.u = sampler.pair(kTime).first;
  return trace<true>(ray);
}

}  // namespace sdlc::render
