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

}  // namespace

Lights::Lights(const Scene& scene, std::span<const std::uint32_t> spheres) {
  if (spheres.empty()) return;
  std::vector<LightSphere> tree_lights;
  tree_lights.reserve(spheres.size());
  double brightest = 0;
  for (const std::uint32_t i : spheres) {
    const Material& material = scene.materials[scene.spheres[i].material];
    brightest = std::fmax(brightest, bounded_brightness(material.color * material.parameter));
  }
  const auto light = [&](std::uint32_t i) {
    const Sphere& sphere = scene.spheres[i];
    const Material& material = scene.materials[sphere.material];
    return Light{.center = sphere.center,
                 .shift = scene.shifts.empty() ? Vec3{} : scene.shifts[i],
                 .radius = sphere.radius,
                 .radiance = material.color * material.parameter,
                 .sphere = i};
  };
  for (const std::uint32_t i : spheres) {
    const Light of = light(i);
    tree_lights.push_back(
        {.center = of.center,
         .shift = of.shift,
         .radius = of.radius,
         .power = bounded_brightness(of.radiance) / brightest * of.radius * of.radius});
  }
  tree_ = LightTree(tree_lights);
  leaves_.reserve(tree_.lights_of_leaves().size());
  leaves_of_spheres_.reserve(spheres.size());
  for (const std::uint32_t index : tree_.lights_of_leaves()) {
    if (index == kNoLight) {
      leaves_.emplace_back();
      continue;
    }
    leaves_of_spheres_.emplace_back(spheres[index], static_cast<std::uint32_t>(leaves_.size()));
    leaves_.push_back(light(spheres[index]));
  }
  std::ranges::sort(leaves_of_spheres_);
}

std::uint32_t Lights::leaf_of(std::uint32_t sphere) const noexcept {
  const auto found = std::ranges::lower_bound(leaves_of_spheres_, sphere, {},
                                              [](const auto& pair) { return pair.first; });
  return found != leaves_of_spheres_.end() && found->first == sphere ? found->second : kNoLight;
}

}  // namespace sdlc::render
