#include "lang/lint/sphere_tree.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace sdlc::lang {

using render::Vec3;

double rounding_margin(Vec3 a, double radius_a, Vec3 b, double radius_b) {
  constexpr double kPart = 0x1p-40;
  return kPart * (max_abs(a) + max_abs(b) + radius_a + radius_b);
}

namespace {

/// The length, where squares would vanish or overflow too.
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
  const double way = safe_length(context.shift_of(index));
  return !(safe_length(point - sphere.center) > (sphere.radius + way) * kNearly);
}

namespace {

constexpr std::uint32_t kLeafSize = 8;
constexpr std::uint64_t kVisitsPerPoll = 1024;

double component(const Vec3& v, std::size_t axis) {
  return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

Vec3 least(Vec3 a, Vec3 b) { return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)}; }
Vec3 largest(Vec3 a, Vec3 b) {
  return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
}

}  // namespace

SphereTree::SphereTree(const LintContext& context, std::span<const std::uint32_t> members)
    : context_(context) {
  items_.reserve(members.size());
  for (const std::uint32_t member : members) {
    const render::Sphere& sphere = context.spheres()[member];
    items_.push_back({sphere.center, sphere.radius, member});
  }
  if (!items_.empty()) build(0, static_cast<std::uint32_t>(items_.size()));
}

std::uint32_t SphereTree::build(std::uint32_t first, std::uint32_t count) {
  Node node{.low = items_[first].center,
            .high = items_[first].center,
            .least = items_[first].radius,
            .largest = items_[first].radius,
            .first = first,
            .count = count};
  for (std::uint32_t i = first; i < first + count; ++i) {
    node.low = least(node.low, items_[i].center);
    node.high = largest(node.high, items_[i].center);
    node.least = std::min(node.least, items_[i].radius);
    node.largest = std::max(node.largest, items_[i].radius);
  }
  const auto index = static_cast<std::uint32_t>(nodes_.size());
  nodes_.push_back(node);
  context_.stop_if_requested();
  if (count <= kLeafSize) return index;

  const Vec3 size = node.high - node.low;
  const std::array<double, 4> sizes{size.x, size.y, size.z, node.largest - node.least};
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
  const std::uint32_t second = build(first + half, count - half);
  nodes_[index].second = second;
  return index;
}

std::vector<std::uint32_t> SphereTree::members() const {
  std::vector<std::uint32_t> members;
  members.reserve(items_.size());
  for (const Item& item : items_) members.push_back(item.sphere);
  return members;
}

double SphereTree::least_distance(const Node& node, Vec3 p) const {
  const Vec3 outside{std::max(0.0, std::max(node.low.x - p.x, p.x - node.high.x)),
                     std::max(0.0, std::max(node.low.y - p.y, p.y - node.high.y)),
                     std::max(0.0, std::max(node.low.z - p.z, p.z - node.high.z))};
  return length(outside);
}

double SphereTree::largest_distance(const Node& node, Vec3 p) const {
  const Vec3 far{std::max(std::fabs(node.low.x - p.x), std::fabs(node.high.x - p.x)),
                 std::max(std::fabs(node.low.y - p.y), std::fabs(node.high.y - p.y)),
                 std::max(std::fabs(node.low.z - p.z), std::fabs(node.high.z - p.z))};
  return length(far);
}

/// Goes through the nodes that `enter` lets in; `look` sees items and says whether to go on.
template <typename Enter, typename Look>
void SphereTree::walk(Enter enter, Look look) {
  if (nodes_.empty()) return;
  constexpr std::size_t kMostWaiting = 64;  // halves of halves: 32 deep at most
  std::array<std::uint32_t, kMostWaiting> waiting;
  std::size_t count = 0;
  waiting[count++] = 0;
  while (count > 0) {
    const std::uint32_t index = waiting[--count];
    const Node& node = nodes_[index];
    if (visits_ >= kMostVisits) return;
    if (++visits_ % kVisitsPerPoll == 0) context_.stop_if_requested();
    if (!enter(node)) continue;
    if (node.second == 0) {
      for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
        if (!look(items_[i])) return;
      }
      continue;
    }
    // The one with the larger spheres first: what is inside of much is found soon.
    const bool is_second_larger = nodes_[node.second].largest > nodes_[index + 1].largest;
    waiting[count++] = is_second_larger ? index + 1 : node.second;
    waiting[count++] = is_second_larger ? node.second : index + 1;
  }
}

std::optional<std::uint32_t> SphereTree::find_around(std::uint32_t sphere) {
  const render::Sphere& inner = context_.spheres()[sphere];
  std::optional<std::uint32_t> found;
  walk(
      [&](const Node& node) {
        return node.largest > inner.radius &&
               least_distance(node, inner.center) + inner.radius <= node.largest;
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
        const double far = largest_distance(node, center);
        const double margin =
            rounding_margin(center, radius, largest(-node.low, node.high), node.largest);
        return least_distance(node, center) < radius + node.largest &&
               node.least <= radius + far + margin && node.largest + far + margin >= radius;
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

std::size_t SphereTree::count_around(Vec3 point) {
  std::size_t count = 0;
  walk(
      [&](const Node& node) {
        if (largest_distance(node, point) * (1 + 0x1p-40) < node.least) {
          count += node.count;
          return false;
        }
        return least_distance(node, point) < node.largest;
      },
      [&](const Item& item) {
        const double margin = rounding_margin(point, 0, item.center, item.radius);
        if (length(point - item.center) + margin < item.radius) ++count;
        return true;
      });
  return count;
}

}  // namespace sdlc::lang
