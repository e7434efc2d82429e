#include "render/shading/light_tree.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>

namespace sdlc::render {
namespace {

struct Box {
  Vec3 low{kInfinity, kInfinity, kInfinity}, high{-kInfinity, -kInfinity, -kInfinity};

  void add(Vec3 p) noexcept {
    low = {std::fmin(low.x, p.x), std::fmin(low.y, p.y), std::fmin(low.z, p.z)};
    high = {std::fmax(high.x, p.x), std::fmax(high.y, p.y), std::fmax(high.z, p.z)};
  }

 private:
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();
};

double along(Vec3 v, int axis) noexcept { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

int longest_axis(Vec3 size) noexcept {
  if (size.x >= size.y && size.x >= size.z) return 0;
  return size.y >= size.z ? 1 : 2;
}

}  // namespace

LightTree::LightTree(const std::vector<LightSphere>& lights) {
  if (lights.empty()) return;
  levels_ = static_cast<int>(std::bit_width(lights.size() - 1));
  const std::size_t leaves = std::size_t{1} << levels_;
  nodes_.resize(2 * leaves);
  lights_of_leaves_.assign(leaves, kNoLight);
  std::vector<std::uint32_t> order(lights.size());
  std::iota(order.begin(), order.end(), 0U);
  build(lights, order.data(), order.data() + order.size(), 1, levels_);
}

void LightTree::build(const std::vector<LightSphere>& lights, std::uint32_t* first,
                      std::uint32_t* last, std::size_t node, int levels_below) {
  if (first == last) return;
  Box ends, centers;
  for (const std::uint32_t* i = first; i != last; ++i) {
    const LightSphere& light = lights[*i];
    const Vec3 end = light.center + light.shift;
    const Vec3 size{light.radius, light.radius, light.radius};
    for (const Vec3 c : {light.center, end}) {
      ends.add(c - size);
      ends.add(c + size);
    }
    centers.add((light.center + end) * 0.5);
  }
  Node& here = nodes_[node];
  here.center = (ends.low + ends.high) * 0.5;
  for (const std::uint32_t* i = first; i != last; ++i) {
    const LightSphere& light = lights[*i];
    for (const Vec3 c : {light.center, light.center + light.shift}) {
      here.radius = std::fmax(here.radius, length(c - here.center) + light.radius);
    }
    here.power += light.power;
  }
  if (levels_below == 0) {
    lights_of_leaves_[node - nodes_.size() / 2] = *first;
    return;
  }
  const int axis = longest_axis(centers.high - centers.low);
  const auto place = [&](std::uint32_t i) {
    return along(lights[i].center * 2 + lights[i].shift, axis);
  };
  std::uint32_t* mid = first + (last - first + 1) / 2;
  std::nth_element(first, mid, last, [&](std::uint32_t a, std::uint32_t b) {
    const double of_a = place(a), of_b = place(b);
    return of_a != of_b ? of_a < of_b : a < b;
  });
  build(lights, first, mid, 2 * node, levels_below - 1);
  build(lights, mid, last, 2 * node + 1, levels_below - 1);
}

}  // namespace sdlc::render
