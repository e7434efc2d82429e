#include "lang/lint/sphere_tree.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace sdlc::lang {

using render::Vec3;

double rounding_margin(Vec3 a, double radius_a, Vec3 b, double radius_b) {
  constexpr double kRelative = 0x1p-40;
  return kRelative * (max_abs(a) + max_abs(b) + radius_a + radius_b);
}

namespace {

/// The length, without underflow or overflow of the squares.
double safe_length(Vec3 v) {
  const double largest = max_abs(v);
  if (!(largest > 0)) return 0;
  return largest * length(Vec3{v.x / largest, v.y / largest, v.z / largest});
}

}  // namespace

bool is_inside(const LintContext& context, std::uint32_t a, std::uint32_t b) {
  const render::Sphere &inner = context.spheres()[a], &outer = context.spheres()[b];
  const Vec3 inner_shift = context.shift_of(a), outer_shift = context.shift_of(b);
  for (const double u : {0.0, 1.0}) {
    const Vec3 from = inner.center + inner_shift * u, to = outer.center + outer_shift * u;
    const double margin = rounding_margin(from, inner.radius, to, outer.radius);
    const Vec3 apart = from - to;
    const double distance = safe_length(apart);
    if (!(distance + inner.radius + margin <= outer.radius)) return false;
  }
  return true;
}

bool is_inside(const LintContext& context, Vec3 point, std::uint32_t index) {
  const render::Sphere& sphere = context.spheres()[index];
  for (const double u : {0.0, 1.0}) {
    const Vec3 center = sphere.center + context.shift_of(index) * u;
    const double margin = rounding_margin(point, 0, center, sphere.radius);
    if (!(safe_length(point - center) + margin < sphere.radius)) return false;
  }
  return true;
}

bool may_be_inside(const LintContext& context, Vec3 point, std::uint32_t index) {
  constexpr double kNearly = 1 + 0x1p-20;
  const render::Sphere& sphere = context.spheres()[index];
  const double motion = safe_length(context.shift_of(index));
  return !(safe_length(point - sphere.center) > (sphere.radius + motion) * kNearly);
}

namespace {

constexpr std::uint32_t kLeafSize = 8;
constexpr std::uint64_t kVisitsPerPoll = 1024;

double component(const Vec3& v, std::size_t axis) {
  return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

Vec3 min(Vec3 a, Vec3 b) { return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)}; }
Vec3 max(Vec3 a, Vec3 b) { return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)}; }

}  // namespace

SphereTree::SphereTree(const LintContext& context, std::span<const std::uint32_t> spheres)
    : context_(context) {
  items_.reserve(spheres.size());
  for (const std::uint32_t i : spheres) {
    items_.push_back({context.spheres()[i].center, context.spheres()[i].radius, i});
  }
  if (!items_.empty()) build(0, static_cast<std::uint32_t>(items_.size()));
}

std::uint32_t SphereTree::build(std::uint32_t first, std::uint32_t count) {
  Node node{.low = items_[first].center,
            .high = items_[first].center,
            .min_radius = items_[first].radius,
            .max_radius = items_[first].radius,
            .first = first,
            .count = count};
  for (std::uint32_t i = first; i < first + count; ++i) {
    node.low = min(node.low, items_[i].center);
    node.high = max(node.high, items_[i].center);
    node.min_radius = std::min(node.min_radius, items_[i].radius);
    node.max_radius = std::max(node.max_radius, items_[i].radius);
  }
  const auto index = static_cast<std::uint32_t>(nodes_.size());
  nodes_.push_back(node);
  context_.stop_if_requested();
  if (count <= kLeafSize) return index;

  const Vec3 size = node.high - node.low;
  const std::array<double, 4> sizes{size.x, size.y, size.z, node.max_radius - node.min_radius};
  const auto axis = static_cast<std::size_t>(std::ranges::max_element(sizes) - sizes.begin());
  const auto key = [axis](const Item& item) {
    return axis == 3 ? item.radius : component(item.center, axis);
  };
  const auto begin = items_.begin() + first;
  const std::uint32_t half = count / 2;
  std::nth_element(begin, begin + half, begin + count, [&](const Item& a, const Item& b) {
    const double of_a = key(a), of_b = key(b);
    return of_a != of_b ? of_a < of_b : a.sphere < b.sphere;  // the same tree everywhere
  });
  build(first, half);
  const std::uint32_t second_child = build(first + half, count - half);
  nodes_[index].second_child = second_child;
  return index;
}

std::vector<std::uint32_t> SphereTree::spheres() const {
  std::vector<std::uint32_t> spheres;
  spheres.reserve(items_.size());
  for (const Item& item : items_) spheres.push_back(item.sphere);
  return spheres;
}

double SphereTree::min_distance(const Node& node, Vec3 p) const {
  const Vec3 outside{std::max(0.0, std::max(node.low.x - p.x, p.x - node.high.x)),
                     std::max(0.0, std::max(node.low.y - p.y, p.y - node.high.y)),
                     std::max(0.0, std::max(node.low.z - p.z, p.z - node.high.z))};
  return length(outside);
}

double SphereTree::max_distance(const Node& node, Vec3 p) const {
  const Vec3 far{std::max(std::fabs(node.low.x - p.x), std::fabs(node.high.x - p.x)),
                 std::max(std::fabs(node.low.y - p.y), std::fabs(node.high.y - p.y)),
                 std::max(std::fabs(node.low.z - p.z), std::fabs(node.high.z - p.z))};
  return length(far);
}

/// Traverses the nodes that `enter` accepts and calls `visit` on their items until it returns
/// false.
template <typename Enter, typename Visit>
void SphereTree::walk(Enter enter, Visit visit) {
  if (nodes_.empty()) return;
  constexpr std::size_t kMaxStack = 64;  // the tree is balanced: at most 32 levels
  std::array<std::uint32_t, kMaxStack> stack;
  std::size_t count = 0;
  stack[count++] = 0;
  while (count > 0) {
    const std::uint32_t index = stack[--count];
    const Node& node = nodes_[index];
    if (visits_ >= kMaxVisits) return;
    if (++visits_ % kVisitsPerPoll == 0) context_.stop_if_requested();
    if (!enter(node)) continue;
    if (node.second_child == 0) {
      for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
        if (!visit(items_[i])) return;
      }
      continue;
    }
    // Larger spheres first: they are more likely to contain another one.
    std::uint32_t first = index + 1, second = node.second_child;
    if (nodes_[second].max_radius > nodes_[first].max_radius) std::swap(first, second);
    stack[count++] = second;
    stack[count++] = first;
  }
}

std::optional<std::uint32_t> SphereTree::find_container(std::uint32_t sphere) {
  const render::Sphere& inner = context_.spheres()[sphere];
  std::optional<std::uint32_t> found;
  walk(
      [&](const Node& node) {
        return node.max_radius > inner.radius &&
               min_distance(node, inner.center) + inner.radius <= node.max_radius;
      },
      [&](const Item& item) {
        if (item.radius > inner.radius && is_inside(context_, sphere, item.sphere)) {
          found = item.sphere;
        }
        return !found;
      });
  return found;
}

std::optional<SphereTree::Crossing> SphereTree::find_crossing(std::uint32_t sphere) {
  const Vec3 center = context_.spheres()[sphere].center;
  const double radius = context_.spheres()[sphere].radius;
  const double parameter = context_.material_of(sphere).parameter;
  std::optional<Crossing> found;
  walk(
      [&](const Node& node) {
        const double far = max_distance(node, center);
        const double margin =
            rounding_margin(center, radius, max(-node.low, node.high), node.max_radius);
        return min_distance(node, center) < radius + node.max_radius &&
               node.min_radius <= radius + far + margin && node.max_radius + far + margin >= radius;
      },
      [&](const Item& item) {
        if (item.sphere >= sphere) return true;
        if (context_.material_of(item.sphere).parameter == parameter) return true;
        const double reach = radius + item.radius, apart = length_squared(center - item.center);
        if (apart > reach * reach) return true;
        const double distance = std::sqrt(apart);
        const double margin = rounding_margin(center, radius, item.center, item.radius);
        const double inside = std::fabs(radius - item.radius);
        if (distance > inside + margin && distance < radius + item.radius - margin) {
          found = {item.sphere, false};
        } else if (distance > margin && std::fabs(distance - inside) <= margin) {
          found = {item.sphere, true};
        }
        return !found;
      });
  return found;
}

std::size_t SphereTree::count_containing(Vec3 point) {
  std::size_t count = 0;
  walk(
      [&](const Node& node) {
        if (max_distance(node, point) * (1 + 0x1p-40) < node.min_radius) {
          count += node.count;
          return false;
        }
        return min_distance(node, point) < node.max_radius;
      },
      [&](const Item& item) {
        const double margin = rounding_margin(point, 0, item.center, item.radius);
        if (length(point - item.center) + margin < item.radius) ++count;
        return true;
      });
  return count;
}

}  // namespace sdlc::lang
