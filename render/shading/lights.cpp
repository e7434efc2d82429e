#include "render/shading/lights.hpp"

#include <algorithm>
#include <cmath>

namespace sdlc::render {
namespace {

// The radiance may overflow in sums; the tree needs finite numbers.
constexpr double kBrightest = 1e300;

double bounded_brightness(LinearRgb radiance) noexcept {
  return std::fmin(radiance.r / 3 + radiance.g / 3 + radiance.b / 3, kBrightest);
}

Light light(const Scene& scene, std::uint32_t i, LinearRgb radiance) {
  const Sphere& sphere = scene.spheres[i];
  return {.center = sphere.center,
          .shift = scene.shifts.empty() ? Vec3{} : scene.shifts[i],
          .radius = sphere.radius,
          .radiance = radiance,
          .sphere = i};
}

}  // namespace

Lights::Lights(const Scene& scene, std::span<const std::uint32_t> spheres) {
  if (spheres.empty()) return;
  std::vector<Light> lights;
  lights.reserve(spheres.size());
  double brightest = 0;
  for (const std::uint32_t i : spheres) {
    const Material& material = scene.materials[scene.spheres[i].material];
    lights.push_back(light(scene, i, material.color * material.parameter));
    brightest = std::fmax(brightest, bounded_brightness(lights.back().radiance));
  }
  std::vector<double> powers;
  powers.reserve(spheres.size());
  for (const Light& of : lights) {
    powers.push_back(bounded_brightness(of.radiance) / brightest * of.radius * of.radius);
  }
  *this = Lights(lights, powers);
}

Lights Lights::casters(const Scene& scene, std::span<const std::uint32_t> spheres) {
  if (spheres.empty()) return {};
  std::vector<Light> casters;
  std::vector<double> areas;
  for (const std::uint32_t i : spheres) {
    casters.push_back(light(scene, i, scene.materials[scene.spheres[i].material].color));
    areas.push_back(casters.back().radius * casters.back().radius);
  }
  return {casters, areas};
}

Lights::Lights(const std::vector<Light>& lights, std::span<const double> powers) {
  std::vector<LightSphere> of_tree;
  of_tree.reserve(lights.size());
  for (std::size_t i = 0; i < lights.size(); ++i) {
    of_tree.push_back({.center = lights[i].center,
                       .shift = lights[i].shift,
                       .radius = lights[i].radius,
                       .power = powers[i]});
  }
  tree_ = LightTree(of_tree);
  leaves_.reserve(tree_.lights_of_leaves().size());
  leaves_of_spheres_.reserve(lights.size());
  for (const std::uint32_t index : tree_.lights_of_leaves()) {
    if (index == kNoLight) {
      leaves_.emplace_back();
      continue;
    }
    const auto leaf = static_cast<std::uint32_t>(leaves_.size());
    leaves_of_spheres_.emplace_back(lights[index].sphere, leaf);
    leaves_.push_back(lights[index]);
  }
  std::ranges::sort(leaves_of_spheres_);
}

std::uint32_t Lights::leaf_of(std::uint32_t sphere) const noexcept {
  const auto found = std::ranges::lower_bound(leaves_of_spheres_, sphere, {},
                                              [](const auto& pair) { return pair.first; });
  return found != leaves_of_spheres_.end() && found->first == sphere ? found->second : kNoLight;
}

}  // namespace sdlc::render
