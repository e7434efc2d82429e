#include "tests/support/reference/light_choice.hpp"

#include <cmath>
#include <cstddef>
#include <limits>

#include "tests/support/reference/light_cone.hpp"

namespace sdlc::test::reference {
namespace {

/// An upper bound, up to a constant factor, on the light that a node sends to `x`: power · cos θ /
/// d². The cosine is that of the highest point of the bounding sphere above the horizon; the bound
/// is 0 if all of it is below.
double importance(const LightTree& tree, std::size_t node, Vec3 x, Vec3 normal) noexcept {
  const LightTree::Node& of = tree.nodes()[node];
  const Vec3 to_center = of.center - x;
  const double height = dot(to_center, normal) + of.radius;
  const double distance = std::fmax(length(to_center), of.radius);
  return height > 0 ? of.power * height / (distance * distance * distance) : 0;
}

}  // namespace

LightChoice choose_light(const LightTree& tree, Vec3 x, Vec3 normal, UniformPair random) noexcept {
  std::size_t node = 1;
  double probability = 1, u = random.first;
  for (int level = 0; level < tree.levels(); ++level) {
    if (level == LightTree::kLevelsPerNumber) u = random.second;
    const double left = importance(tree, 2 * node, x, normal);
    const double right = importance(tree, 2 * node + 1, x, normal);
    const double total = left + right;
    // No light arrives from either child; or x is so near that the bounds overflow.
    if (!(total > 0 && total < std::numeric_limits<double>::infinity())) return {};
    const double share_left = left / total, share_right = right / total;
    const bool goes_left = u < share_left;
    u = goes_left ? u / share_left : (u - share_left) / share_right;
    probability *= goes_left ? share_left : share_right;
    node = 2 * node + (goes_left ? 0 : 1);
  }
  return {static_cast<std::uint32_t>(node - tree.nodes().size() / 2), probability};
}

double probability_of(const LightTree& tree, std::uint32_t leaf, Vec3 x, Vec3 normal) noexcept {
  std::size_t node = 1;
  double probability = 1;
  for (int level = tree.levels() - 1; level >= 0; --level) {
    const double left = importance(tree, 2 * node, x, normal);
    const double right = importance(tree, 2 * node + 1, x, normal);
    const double total = left + right;
    if (!(total > 0 && total < std::numeric_limits<double>::infinity())) return 0;
    const std::size_t side = leaf >> level & 1;
    probability *= (side == 0 ? left : right) / total;
    node = 2 * node + side;
  }
  return probability;
}

std::optional<Connection> connect(const Lights& lights, const LitPlace& at, UniformPair choice,
                                  UniformPair direction) noexcept {
  const LightChoice chosen = choose_light(lights.tree(), at.x, at.normal, choice);
  if (!(chosen.probability > 0)) return std::nullopt;
  const Light& light = lights.leaves()[chosen.leaf];
  const LightCone cone = light_cone(light.center_at(at.u) - at.x, light.radius);
  if (!(cone.height > 0)) return std::nullopt;
  const LightDirection way = sample_cone(cone, light.radius, direction);
  const double cosine = dot(way.direction, at.normal);
  const double scattering = at.scattering(way.direction, cosine);
  if (!(cosine > 0 && scattering > 0)) return std::nullopt;
  return Connection{
      .direction = way.direction,
      .distance = way.distance,
      .radiance = light.radiance * scattering_weight(chosen.probability, cone, scattering),
      .sphere = light.sphere};
}

double weight_of_hit(const Lights& lights, std::uint32_t sphere, const LitPlace& at,
                     Vec3 direction) noexcept {
  const std::uint32_t leaf = lights.leaf_of(sphere);
  if (leaf == kNoLight) return 1;
  const Light& light = lights.leaves()[leaf];
  return scattering_weight(probability_of(lights.tree(), leaf, at.x, at.normal),
                           light_cone(light.center_at(at.u) - at.x, light.radius),
                           at.scattering(direction, std::fabs(dot(direction, at.normal))));
}

}  // namespace sdlc::test::reference
