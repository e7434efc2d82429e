#include "render/shading/choose_lights.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "render/exactness/near_pairs.hpp"
#include "render/exactness/rebase.hpp"
#include "render/math/color.hpp"
#include "render/math/vec3.hpp"
#include "render/shading/optics.hpp"

namespace sdlc::render {
namespace {

constexpr double kLargestShare = 0.25;  // share of the scattered directions that an emitter may
                                        // cover to be sampled
constexpr std::size_t kMaxReceivers = 256, kMinReceivers = 16;
constexpr std::size_t kMaxPairs = std::size_t{1} << 22;  // of receivers and emitters

double brightness(LinearRgb c) noexcept { return c.r / 3 + c.g / 3 + c.b / 3; }

bool shines(const Material& material) noexcept {
  return material.type == MaterialType::Emissive && material.parameter > 0 &&
         !is_black(material.color);
}

std::vector<std::uint32_t> emitters_of(const Scene& scene) {
  std::vector<std::uint32_t> emitters;
  if (std::ranges::none_of(scene.materials, shines)) return emitters;
  for (std::uint32_t i = 0; i < scene.spheres.size(); ++i) {
    const Sphere& sphere = scene.spheres[i];
    if (sphere.radius > 0 && shines(scene.materials[sphere.material])) emitters.push_back(i);
  }
  return emitters;
}

/// A point that receives light, weighted by the apparent size of its sphere.
struct Receiver {
  Vec3 place;
  double weight = 0;
};

/// The points nearest to the camera on the diffuse spheres with the largest apparent size; ties go
/// to the first in the scene. Coordinates are rebased.
std::vector<Receiver> receivers_of(const Scene& scene, const Rebase& rebase,
                                   std::size_t max_count) {
  std::vector<Receiver> receivers;
  const auto is_larger = [](const Receiver& a, const Receiver& b) { return a.weight > b.weight; };
  for (const Sphere& from : scene.spheres) {
    if (from.radius <= 0 || scene.materials[from.material].type != MaterialType::Diffuse) continue;
    const Sphere sphere = rebase.sphere(from);
    const double distance = moderate_length(sphere.center);
    const Vec3 to_camera = distance > 0 ? sphere.center / -distance : Vec3{0, 0, 1};
    const double size = distance > sphere.radius ? sphere.radius / distance : 1;
    receivers.push_back({sphere.center + to_camera * sphere.radius, size * size});
    // Trim occasionally, to avoid a list of all spheres.
    if (receivers.size() == 16 * max_count) {
      std::ranges::stable_sort(receivers, is_larger);
      receivers.resize(max_count);
    }
  }
  std::ranges::stable_sort(receivers, is_larger);
  if (receivers.size() > max_count) receivers.resize(max_count);
  return receivers;
}

/// Whether an opaque sphere encloses the camera.
bool is_closed_in(const Scene& scene, const Rebase& rebase) {
  return std::ranges::any_of(scene.spheres, [&](const Sphere& from) {
    if (scene.materials[from.material].type == MaterialType::Transmissive) return false;
    const Sphere sphere = rebase.sphere(from);
    return moderate_length(sphere.center) < sphere.radius;
  });
}

double share_of(const Sphere& emitter, Vec3 place) noexcept {
  const Vec3 way = emitter.center - place;
  const double squared = length_squared(way), radius_squared = emitter.radius * emitter.radius;
  return squared > radius_squared ? 0.5 * radius_squared / squared : 1;
}

std::vector<std::uint32_t> chosen_by_geometry(const Scene& scene,
                                              const std::vector<std::uint32_t>& emitters) {
  const Rebase rebase(scene);
  const std::size_t max_count =
      std::clamp(kMaxPairs / emitters.size(), kMinReceivers, kMaxReceivers);
  const std::vector<Receiver> receivers = receivers_of(scene, rebase, max_count);
  double weights = 0;
  for (const Receiver& receiver : receivers) weights += receiver.weight;
  if (!(weights > 0)) return {};

  // Relative to the brightest, so that no square overflows.
  const auto radiance = [&](std::uint32_t i) {
    const Material& of = scene.materials[scene.spheres[i].material];
    return std::fmin(brightness(of.color * of.parameter), 1e300);
  };
  double unit_of_light = 0;
  for (const std::uint32_t i : emitters) unit_of_light = std::fmax(unit_of_light, radiance(i));
  const double sky = is_closed_in(scene, rebase) ? 0
                                                 : brightness(scene.background.bottom) / 2 +
                                                       brightness(scene.background.top) / 2;

  std::vector<double> levels(receivers.size(), sky / unit_of_light);
  std::vector<std::uint32_t> chosen;
  double gained = 0, remaining = 0;
  for (const std::uint32_t i : emitters) {
    const Sphere emitter = rebase.sphere(scene.spheres[i]);
    const double bright = radiance(i) / unit_of_light;
    double share = 0, variance = 0;
    for (std::size_t r = 0; r < receivers.size(); ++r) {
      const double f = share_of(emitter, receivers[r].place), weight = receivers[r].weight;
      share += weight * f;
      variance += weight * bright * bright * f * (1 - f);
      levels[r] += bright * f;
    }
    const bool is_small = share <= kLargestShare * weights;
    if (is_small) chosen.push_back(i);
    (is_small ? gained : remaining) += variance;
  }
  for (std::size_t r = 0; r < receivers.size(); ++r) {
    remaining += receivers[r].weight * levels[r] * levels[r];
  }
  if (gained < remaining) return {};
  return chosen;
}

}  // namespace

std::vector<std::uint32_t> choose_lights(const Scene& scene, LightSampling sampling) {
  if (sampling == LightSampling::Off) return {};
  std::vector<std::uint32_t> emitters = emitters_of(scene);
  if (sampling != LightSampling::Auto || emitters.empty()) return emitters;
  return chosen_by_geometry(scene, emitters);
}

bool has_rough_metal(const Scene& scene) noexcept {
  return std::ranges::any_of(scene.materials, is_rough);
}

bool is_metal_rough_for(const Scene& scene, std::span<const std::uint32_t> lights) {
  constexpr double kShare = 0.85;  // of the cone in which metal scatters
  std::size_t pairs = 0;
  for (const Sphere& metal : scene.spheres) {
    const Material& material = scene.materials[metal.material];
    if (!is_rough(material) || metal.radius <= 0) continue;
    for (const std::uint32_t i : lights) {
      if (++pairs > kMaxPairs) return true;
      const Sphere& light = scene.spheres[i];
      const double distance =
          std::fabs(moderate_length(light.center - metal.center) - metal.radius);
      if (light.radius < kShare * material.parameter * distance) return true;
    }
  }
  return false;
}

std::vector<std::uint32_t> choose_casters(const Scene& scene,
                                          std::span<const std::uint32_t> excluded) {
  std::vector<std::uint32_t> casters;
  for (std::uint32_t i = 0; i < scene.spheres.size(); ++i) {
    const Material& material = scene.materials[scene.spheres[i].material];
    const bool is_mirror = material.type == MaterialType::Specular && material.parameter == 0;
    const bool is_glass = material.type == MaterialType::Transmissive && material.parameter > 1;
    if ((is_mirror || is_glass) && scene.spheres[i].radius > 0 && !is_black(material.color) &&
        !contains(excluded, i)) {
      casters.push_back(i);
    }
  }
  return casters;
}

}  // namespace sdlc::render
