#include "render/integrator/path_integrator.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "render/material/scatter.hpp"
#include "render/scene/camera_surface.hpp"
#include "render/scene/rebase.hpp"
#include "render/scene/touching.hpp"

namespace sdlc::render {

namespace {

double mean_square(LinearRgb c) noexcept { return (c.r * c.r + c.g * c.g + c.b * c.b) / 3; }

/// Ends a path with the radiance `arriving`, weighted by `weight`; a plain path would get all of
/// it.
LinearRgb end_with(LinearRgb arriving, double weight, PlainPaths* plain) noexcept {
  if (plain != nullptr) plain->squares += mean_square(arriving) * weight;
  return arriving * weight;
}

}  // namespace

PathIntegrator::PathIntegrator(Scene scene, int max_depth,
                               std::optional<std::span<const SpherePair>> near_pairs,
                               std::span<const std::uint32_t> lights, EmitterTally* emitters)
    : pinhole_(scene.camera),
      background_(scene.background),
      has_constant_background_(scene.background.is_constant()),
      has_motion_(!scene.shifts.empty()),
      max_depth_(max_depth),
      emitters_(emitters) {
  rebase_to_camera(scene);
  part_touching(scene, Precision::Double, {}, near_pairs);
  bvh_ = Bvh(scene.spheres, scene.shifts);
  lights_ = Lights(scene, lights);
  materials_ = std::move(scene.materials);
  material_of_slot_.reserve(bvh_.size());
  for (std::uint32_t slot = 0; slot < bvh_.size(); ++slot) {
    material_of_slot_.push_back(scene.spheres[bvh_.index_in_scene(slot)].material);
  }
  find_camera_surfaces();
}

void PathIntegrator::find_camera_surfaces() {
  for (std::uint32_t slot = 0; slot < bvh_.size(); ++slot) {
    const Vec3 center = bvh_.center<false>(slot, 0);
    const Vec3 shift = has_motion_ ? bvh_.center<true>(slot, 1) - center : Vec3{};
    const Sphere sphere{.center = center, .radius = bvh_.sphere(slot).radius};
    if (!has_camera_on_it(sphere, shift)) continue;
    camera_surfaces_.push_back({.sphere = slot, .normal = unit(-center)});
  }
}

LinearRgb PathIntegrator::sample(double s, double t, const PathSampler& sampler, PathCounts& counts,
                                 const std::atomic<bool>* cancel,
                                 PlainPaths* plain) const noexcept {
  Ray ray{.origin = {}, .direction = pinhole_.direction(s, t)};
  if (!has_motion_) return li<false>(ray, sampler, counts, cancel, plain);
  ray.u = sampler.pair(kTime).first;
  return li<true>(ray, sampler, counts, cancel, plain);
}

/// The first hit of a camera ray if the camera is on several surfaces at once: each is treated as a
/// surface that the ray departs from.
template <bool kMoving>
BvhHit PathIntegrator::first_hit_from_surfaces(const Ray& ray) const noexcept {
  BvhHit nearest;
  for (const Departure& departure : camera_surfaces_) {
    const BvhHit hit = bvh_.intersect<kMoving>(ray, departure);
    const bool is_other_surface =
        hit.sphere != departure.sphere &&
        std::any_of(camera_surfaces_.begin(), camera_surfaces_.end(),
                    [&](const Departure& other) { return other.sphere == hit.sphere; });
    if (!is_other_surface && hit.t < nearest.t) nearest = hit;
  }
  return nearest;
}

LinearRgb PathIntegrator::background(Vec3 direction) const noexcept {
  if (has_constant_background_) return background_.bottom;
  const double t = 0.5 * (direction.y + 1);
  return background_.bottom * (1 - t) + background_.top * t;
}

/// Next event estimation: the contribution of one light, chosen for the diffuse surface point at
/// the origin of `ray` (its direction is not used). Includes `beta` and cos/π divided by the
/// densities of both techniques.
template <bool kMoving>
LinearRgb PathIntegrator::direct_light(const Ray& ray, const Departure& departure, Vec3 facing,
                                       const PathSampler& sampler, int vertex, LinearRgb beta,
                                       PathCounts& counts, PlainPaths* plain) const noexcept {
  const VertexSampler random(sampler, vertex);
  if (plain != nullptr) ++plain->choices;
  const auto connection = lights_.connect({.x = ray.origin, .normal = facing, .u = ray.u},
                                          random(kChoice), random(kLight));
  if (!connection) return LinearRgb{};
  ++counts.rays;
  if (plain != nullptr) ++plain->shadow_rays;
  const Ray towards{.origin = ray.origin, .direction = connection->direction, .u = ray.u};
  const BvhHit hit = bvh_.intersect<kMoving>(towards, departure);
  // If the ray hits or just misses the light's own surface, rounding decides; both count as
  // visible.
  const bool is_hidden = hit.sphere != kNoSphere && hit.t < connection->distance &&
                         bvh_.index_in_scene(hit.sphere) != connection->sphere;
  if (is_hidden) return LinearRgb{};
  count_reached(connection->sphere, LightPath::Direct);
  const LinearRgb brought = beta * connection->radiance;
  if (plain != nullptr) {
    ++plain->connections;
    if (connection->weight > 0) plain->squares += mean_square(brought) / connection->weight;
  }
  return brought;
}

template <bool kMoving>
LinearRgb PathIntegrator::li(Ray ray, const PathSampler& sampler, PathCounts& counts,
                             const std::atomic<bool>* cancel, PlainPaths* plain) const noexcept {
  constexpr int kRaysBetweenLooks = 4096;  // a walk may have 1e9 rays
  LinearRgb beta{1};                       // throughput of the walk so far
  LinearRgb gathered;                      // radiance from connections to lights
  Departure departure;
  Vec3 facing;
  bool left_diffuse = false;  // the previous surface was diffuse, and a light was sampled there
  PathHistory history;
  for (int depth = 0; depth < max_depth_; ++depth) {
    if (depth % kRaysBetweenLooks == kRaysBetweenLooks - 1 && cancel != nullptr &&
        cancel->load(std::memory_order_relaxed)) {
      return LinearRgb{};
    }
    ++counts.rays;
    PlainPaths* const of_path = depth > 0 ? plain : nullptr;
    BvhHit hit;
    if (depth == 0 && !camera_surfaces_.empty()) {
      departure = camera_surfaces_.front();
      hit = camera_surfaces_.size() == 1 ? bvh_.intersect<kMoving>(ray, departure)
                                         : first_hit_from_surfaces<kMoving>(ray);
    } else {
      hit = bvh_.intersect<kMoving>(ray, departure);
    }
    if (hit.sphere == kNoSphere) {
      return gathered + end_with(beta * background(ray.direction), 1, of_path);
    }

    const Material& material = materials_[material_of_slot_[hit.sphere]];
    if (material.type == MaterialType::Unlit) {
      count_reached(bvh_.index_in_scene(hit.sphere), light_path(history));
      return gathered + end_with(beta * material.color, 1, of_path);
    }
    if (material.type == MaterialType::Emissive) {
      count_reached(bvh_.index_in_scene(hit.sphere), light_path(history));
      const LinearRgb arriving = beta * (material.color * material.parameter);
      if (!left_diffuse) return gathered + end_with(arriving, 1, of_path);
      const double cosine = std::fabs(dot(ray.direction, facing));
      const double weight = lights_.weight_of_hit(
          bvh_.index_in_scene(hit.sphere), {.x = ray.origin, .normal = facing, .u = ray.u}, cosine);
      return gathered + end_with(arriving, weight, of_path);
    }

    const Vec3 center = bvh_.center<kMoving>(hit.sphere, ray.u);
    // Relative to the centre, not in world coordinates: the distance to the origin cancels.
    const Vec3 outward = hit.sphere == departure.sphere
                             ? rehit_normal(ray.direction, departure.normal)
                             : unit((ray.origin - center) + ray.direction * hit.t);
    facing = dot(ray.direction, outward) > 0 ? -outward : outward;
    const VertexSampler vertex(sampler, depth);
    Vec3 direction;
    switch (material.type) {
      case MaterialType::Diffuse: direction = scatter_diffuse(facing, vertex); break;
      case MaterialType::Specular:
        if (!scatter_specular(ray.direction, facing, material.parameter, vertex, direction)) {
          return gathered;
        }
        break;
      default:
        direction = scatter_transmissive(ray.direction, outward, material.parameter,
                                         material.fresnel, vertex);
    }
    beta *= material.color;
    ray.origin = center + outward * bvh_.sphere(hit.sphere).radius;
    ray.direction = direction;
    departure = {.sphere = hit.sphere, .normal = outward};
    const bool is_diffuse = material.type == MaterialType::Diffuse;
    history = {.has_scattered = true,
               .has_met_diffuse = history.has_met_diffuse || is_diffuse,
               .leaves_diffuse = is_diffuse};
    left_diffuse = is_diffuse && !lights_.empty();
    if (left_diffuse && depth + 1 < max_depth_) {
      gathered +=
          direct_light<kMoving>(ray, departure, facing, sampler, depth, beta, counts, plain);
    }
  }
  ++counts.truncated_paths;
  return gathered;
}

}  // namespace sdlc::render
