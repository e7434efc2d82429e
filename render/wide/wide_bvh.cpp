#include "render/wide/wide_bvh.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "render/math/box.hpp"
#include "render/math/vec3.hpp"

namespace sdlc::render {
namespace {

/// Of boxes, on each side, in a scene of extent 2. It exceeds by far what rounding does across the
/// ray to the tests of box and sphere, for rays that begin within the scene: some u · 2 in float,
/// where the criterion of precision keeps radii above 2500 u · 2. What it does along the ray, and
/// to those that come from far away, is the search's to allow for.
template <typename T>
constexpr double kMargin = sizeof(T) == 4 ? 0x1p-18 : 0x1p-44;

struct Member {
  Box box;
  std::uint32_t sphere = 0;

  double middle(std::size_t axis) const noexcept { return box.low[axis] + box.high[axis]; }
};

/// The members [begin, end) and the box around them.
struct Group {
  std::size_t begin = 0, end = 0;
  Box box;

  std::size_t count() const noexcept { return end - begin; }
  bool is_leaf() const noexcept { return count() <= kBvhWidth; }
};

/// What the spheres of a group cost a ray that meets its box: one operation for each sixteen.
double leaf_cost(std::size_t count) noexcept {
  return static_cast<double>((count + kBvhWidth - 1) / kBvhWidth);
}

/// Sorts the members into groups, top-down, by the surface area heuristic.
class Splitter {
 public:
  explicit Splitter(std::vector<Member>& members) : members_(members) {}

  Group group(std::size_t begin, std::size_t end) const {
    Group group{.begin = begin, .end = end, .box = {}};
    for (std::size_t i = begin; i < end; ++i) group.box.add(members_[i].box);
    return group;
  }

  /// Both parts of a group of more than one member.
  std::array<Group, 2> split(const Group& whole) {
    const std::size_t middle =
        whole.count() <= kMostSwept ? sweep(whole) : partition_by_bins(whole);
    return {group(whole.begin, middle), group(middle, whole.end)};
  }

 private:
  static constexpr std::size_t kBins = 16;
  static constexpr std::size_t kMostSwept = 128;  // every place to split is tried

  void sort(const Group& whole, std::size_t axis) {
    const auto first = members_.begin() + static_cast<std::ptrdiff_t>(whole.begin);
    const auto last = members_.begin() + static_cast<std::ptrdiff_t>(whole.end);
    std::sort(first, last, [axis](const Member& a, const Member& b) {
      const double of_a = a.middle(axis), of_b = b.middle(axis);
      return of_a != of_b ? of_a < of_b : a.sphere < b.sphere;
    });
  }

  /// Sorts the group along its best axis; where the second part begins.
  std::size_t sweep(const Group& whole) {
    double best = Box::kInfinity;
    std::size_t best_axis = 0, best_middle = whole.begin + whole.count() / 2;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      sort(whole, axis);
      std::array<double, kMostSwept> cost_above{};
      Box box;
      for (std::size_t i = whole.end - 1; i > whole.begin; --i) {
        box.add(members_[i].box);
        cost_above[i - whole.begin] = box.half_area() * leaf_cost(whole.end - i);
      }
      box = {};
      for (std::size_t i = whole.begin + 1; i < whole.end; ++i) {
        box.add(members_[i - 1].box);
        const double cost =
            box.half_area() * leaf_cost(i - whole.begin) + cost_above[i - whole.begin];
        if (cost < best) best = cost, best_axis = axis, best_middle = i;
      }
    }
    sort(whole, best_axis);
    return best_middle;
  }

  /// Sorts the group by bins along its best axis; where the second part begins.
  std::size_t partition_by_bins(const Group& whole) {
    Box middles;
    for (std::size_t i = whole.begin; i < whole.end; ++i) {
      const Member& m = members_[i];
      middles.add({m.middle(0), m.middle(1), m.middle(2)}, 0);
    }
    double best = Box::kInfinity;
    std::size_t best_axis = 0, best_bin = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double size = middles.high[axis] - middles.low[axis];
      if (!(size > 0) || !std::isfinite(kBins / size)) continue;
      std::array<Box, kBins> boxes;
      std::array<std::size_t, kBins> counts{};
      for (std::size_t i = whole.begin; i < whole.end; ++i) {
        const std::size_t bin = bin_of(members_[i], middles, axis);
        boxes[bin].add(members_[i].box);
        ++counts[bin];
      }
      std::array<double, kBins> cost_above{};
      Box above;
      std::size_t count = 0;
      for (std::size_t bin = kBins - 1; bin > 0; --bin) {
        above.add(boxes[bin]);
        count += counts[bin];
        cost_above[bin] = count > 0 ? above.half_area() * leaf_cost(count) : 0;
      }
      Box below;
      count = 0;
      for (std::size_t bin = 1; bin < kBins; ++bin) {
        below.add(boxes[bin - 1]);
        count += counts[bin - 1];
        if (count == 0 || count == whole.count()) continue;
        const double cost = below.half_area() * leaf_cost(count) + cost_above[bin];
        if (cost < best) best = cost, best_axis = axis, best_bin = bin;
      }
    }
    // All middles in one place: any halves will do.
    if (best == Box::kInfinity) return whole.begin + whole.count() / 2;
    const auto first = members_.begin() + static_cast<std::ptrdiff_t>(whole.begin);
    const auto last = members_.begin() + static_cast<std::ptrdiff_t>(whole.end);
    const auto cut = std::partition(first, last, [&](const Member& member) {
      return bin_of(member, middles, best_axis) < best_bin;
    });
    return static_cast<std::size_t>(cut - members_.begin());
  }

  static std::size_t bin_of(const Member& member, const Box& middles, std::size_t axis) noexcept {
    const double size = middles.high[axis] - middles.low[axis];
    const double place = (member.middle(axis) - middles.low[axis]) * (kBins / size);
    return std::min(static_cast<std::size_t>(place), kBins - 1);
  }

  std::vector<Member>& members_;
};

template <typename T>
T rounded_down(double v) noexcept {
  const auto rounded = static_cast<T>(v);
  return rounded > v ? std::nextafter(rounded, -std::numeric_limits<T>::infinity()) : rounded;
}

/// Builds the nodes of a hierarchy.
template <typename T>
class Builder {
 public:
  Builder(WideBvh<T>& bvh, std::vector<Member> members)
      : bvh_(bvh), members_(std::move(members)), splitter_(members_) {}

  void build() {
    if (members_.empty()) return;
    build_node(splitter_.group(0, members_.size()), 0);
  }

 private:
  // So deep, groups are halved: the nodes that wait while a ray is followed have to find room.
  static constexpr int kMostSahDepth = 24;

  std::uint32_t build_node(const Group& whole, int depth) {
    const auto index = static_cast<std::uint32_t>(bvh_.nodes.size());
    bvh_.nodes.emplace_back();
    std::vector<Group> groups{whole};
    while (groups.size() < kBvhWidth) {
      // The largest box first: it is what most rays meet.
      const auto area = [](const Group& g) { return g.is_leaf() ? -1 : g.box.half_area(); };
      const auto largest = std::ranges::max_element(groups, {}, area);
      if (largest->is_leaf()) break;
      const auto parts = depth < kMostSahDepth ? splitter_.split(*largest) : halves(*largest);
      *largest = parts[0];
      groups.push_back(parts[1]);
    }
    typename WideBvh<T>::Node node;
    for (std::size_t child = 0; child < kBvhWidth; ++child) {
      if (child < groups.size()) {
        store_box(groups[child].box, child, node);
        node.children[child] = groups[child].is_leaf() ? add_leaf(groups[child])
                                                       : build_node(groups[child], depth + 1);
      } else {
        store_no_box(child, node);
        node.children[child] = 0;
      }
    }
    bvh_.nodes[index] = node;
    return index;
  }

  std::array<Group, 2> halves(const Group& whole) const {
    const std::size_t middle = whole.begin + whole.count() / 2;
    return {splitter_.group(whole.begin, middle), splitter_.group(middle, whole.end)};
  }

  std::uint32_t add_leaf(const Group& group) {
    const auto leaf = static_cast<std::uint32_t>(bvh_.slots.size() / kBvhWidth);
    const std::size_t first = bvh_.slots.size();
    for (std::size_t i = group.begin; i < group.end; ++i) {
      bvh_.slots.push_back(members_[i].sphere);
    }
    std::sort(bvh_.slots.begin() + static_cast<std::ptrdiff_t>(first), bvh_.slots.end());
    bvh_.slots.resize(first + kBvhWidth, WideBvh<T>::kNoSphere);
    return leaf | WideBvh<T>::kLeaf;
  }

  static void store_box(const Box& box, std::size_t child, typename WideBvh<T>::Node& node) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      node.bounds[axis][0][child] = rounded_down<T>(box.low[axis] - kMargin<T>);
      node.bounds[axis][1][child] = -rounded_down<T>(-box.high[axis] - kMargin<T>);
    }
  }

  static void store_no_box(std::size_t child, typename WideBvh<T>::Node& node) {
    constexpr auto kFar =
        static_cast<T>(1e15);  // its products with any inverse of a direction are finite
    for (std::size_t axis = 0; axis < 3; ++axis) {
      node.bounds[axis][0][child] = kFar;
      node.bounds[axis][1][child] = -kFar;
    }
  }

  WideBvh<T>& bvh_;
  std::vector<Member> members_;
  Splitter splitter_;
};

}  // namespace

template <typename T>
WideBvh<T>::WideBvh(const Scene& scene, std::span<const std::uint32_t> spheres) {
  std::vector<Member> members;
  members.reserve(spheres.size());
  for (const std::uint32_t index : spheres) {
    const Sphere& sphere = scene.spheres[index];
    Member member{.box = {}, .sphere = index};
    member.box.add(sphere.center, sphere.radius);
    if (!scene.shifts.empty()) {
      member.box.add(sphere.center + scene.shifts[index], sphere.radius);
    }
    members.push_back(member);
  }
  Builder<T>(*this, std::move(members)).build();
}

template struct WideBvh<float>;
template struct WideBvh<double>;

}  // namespace sdlc::render
