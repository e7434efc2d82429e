#include "render/exactness/near_pairs.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <utility>

#include "render/exactness/curve_order.hpp"
#include "render/exactness/movement.hpp"
#include "render/math/box.hpp"
#include "render/math/vec3.hpp"
#include "render/parallel/parallel_for.hpp"

namespace sdlc::render {
namespace {

constexpr std::size_t kWidth = 16;  // spheres per leaf, and boxes per node
// The max error of a distance after rounding positions, radii and distances to float, in units of
// the extent: 16 u.
constexpr double kFloatError = 0x1p-20;

/// Sixteen boxes, or sphere bounds, as a structure of arrays.
class Boxes {
 public:
  static constexpr std::uint32_t kAll = 0xFFFF;

  std::array<std::array<float, kWidth>, 3> low, high;

  /// Empty boxes intersect nothing.
  void clear() {
    for (auto& axis : low) axis.fill(std::numeric_limits<float>::infinity());
    for (auto& axis : high) axis.fill(-std::numeric_limits<float>::infinity());
  }
  /// Stores the bounds of all boxes of `other` at `place`.
  void add(std::size_t place, const Boxes& other) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      Four min = four(other.low[axis], 0), max = four(other.high[axis], 0);
      for (std::size_t first = 4; first < kWidth; first += 4) {
        const Four lows = four(other.low[axis], first), highs = four(other.high[axis], first);
        min = lows < min ? lows : min;
        max = highs > max ? highs : max;
      }
      low[axis][place] = std::min({min[0], min[1], min[2], min[3]});
      high[axis][place] = std::max({max[0], max[1], max[2], max[3]});
    }
  }
  /// The boxes in `among` that the box at `place` of `other` intersects, as a bit mask.
  std::uint32_t meet(const Boxes& other, std::size_t place, std::uint32_t among = kAll) const {
    FourBits met{};
    for (std::size_t first = 0; first < kWidth; first += 4) {
      if ((among >> first & 0xF) == 0) continue;
      auto is_met = four(low[0], first) <= other.high[0][place];
      is_met &= other.low[0][place] <= four(high[0], first);
      for (std::size_t axis = 1; axis < 3; ++axis) {
        is_met &= four(low[axis], first) <= other.high[axis][place];
        is_met &= other.low[axis][place] <= four(high[axis], first);
      }
      met |= is_met & (FourBits{1, 2, 4, 8} << static_cast<std::int32_t>(first));
    }
    return static_cast<std::uint32_t>(met[0] | met[1] | met[2] | met[3]) & among;
  }

 private:
  using Four = float __attribute__((vector_size(16)));
  using FourBits = std::int32_t __attribute__((vector_size(16)));

  static Four four(const std::array<float, kWidth>& row, std::size_t first) {
    Four v;
    std::memcpy(&v, row.data() + first, sizeof v);
    return v;
  }
};

/// The common bounds of the spheres in a leaf or below a node: their centres while the shutter is
/// open, and their radii.
struct Common {
  Box centers;
  double min_radius = Box::kInfinity, max_radius = 0;

  void add(const Common& other) {
    centers.add(other.centers);
    min_radius = std::min(min_radius, other.min_radius);
    max_radius = std::max(max_radius, other.max_radius);
  }
};

class Search {
 public:
  Search(const Crowd& spheres, const Nearness& nearness)
      : spheres_(spheres),
        gap_(nearness.gap_of_extent * spheres.extent()),
        gap_of_radius_(nearness.gap_of_radius),
        spread_(nearness.spread_of_extent * spheres.extent()),
        order_(curve_order(spheres)) {
    build();
  }

  std::optional<std::vector<SpherePair>> run() {
    const std::size_t leaves = (order_.size() + kWidth - 1) / kWidth;
    const std::size_t parts = (leaves + kLeavesPerPart - 1) / kLeavesPerPart;
    max_comparisons_ = kMaxComparisons + 100 * leaves;
    max_pairs_ = kMaxPairs + kMaxPairsPerSphere * order_.size();
    std::vector<std::vector<SpherePair>> found(parts);
    parallel_for(parts, [&](std::size_t part) {
      const std::size_t end = std::min(leaves, (part + 1) * kLeavesPerPart);
      for (std::size_t leaf = part * kLeavesPerPart; leaf < end && !is_too_much(); ++leaf) {
        find(leaf, found[part]);
      }
    });
    if (is_too_much()) return std::nullopt;
    std::vector<SpherePair> pairs;
    for (const auto& of_part : found) pairs.insert(pairs.end(), of_part.begin(), of_part.end());
    return pairs;
  }

 private:
  static constexpr std::size_t kLeavesPerPart = 256;
  // Comparisons of leaves, in addition to a hundred per leaf; usual scenes need about twenty.
  static constexpr std::size_t kMaxComparisons = 1 << 17;
  static constexpr std::size_t kMaxPairs = 1 << 20;
  static constexpr std::size_t kMaxPairsPerSphere = 24;  // a lattice of touching spheres has 6
  // Sphere tests that take as long as one comparison of leaves without tests.
  static constexpr std::size_t kTestsPerComparison = 16;

  /// Whether the limits are exceeded. The sums only grow, so the result does not depend on the
  /// timing of threads.
  bool is_too_much() const { return comparisons_ > max_comparisons_ || pairs_ > max_pairs_; }

  /// Nodes of one height. Level 0 holds the leaves, with the boxes of their spheres; each node of a
  /// higher level holds sixteen nodes of the level below.
  struct Level {
    // Not initialised: the threads that fill them touch the memory first.
    std::unique_ptr<Boxes[]> boxes;    // NOLINT
    std::unique_ptr<Common[]> common;  // NOLINT
    std::size_t count;

    explicit Level(std::size_t nodes)
        : boxes(std::make_unique_for_overwrite<Boxes[]>(nodes)),    // NOLINT
          common(std::make_unique_for_overwrite<Common[]>(nodes)),  // NOLINT
          count(nodes) {}
  };

  void build() {
    levels_.emplace_back((order_.size() + kWidth - 1) / kWidth);
    fill(levels_[0], order_.size(), [&](Boxes& boxes, std::size_t place, std::size_t k) {
      add_sphere(boxes, place, order_[k]);
      return common_of(order_[k]);
    });
    while (levels_.back().count > 1) {
      const Level& below = levels_.back();
      Level above((below.count + kWidth - 1) / kWidth);
      fill(above, below.count, [&](Boxes& boxes, std::size_t place, std::size_t k) {
        boxes.add(place, below.boxes[k]);
        return below.common[k];
      });
      levels_.push_back(std::move(above));
    }
  }

  /// `add(boxes, place, k)` stores item `k` of `count` in its node, and returns its Common bounds.
  template <typename Add>
  static void fill(Level& level, std::size_t count, const Add& add) {
    constexpr std::size_t kNodesPerTask = 256;
    const auto fill_node = [&](std::size_t node) {
      level.boxes[node].clear();
      Common common;
      const std::size_t end = std::min(count, (node + 1) * kWidth);
      for (std::size_t k = node * kWidth; k < end; ++k) {
        common.add(add(level.boxes[node], k % kWidth, k));
      }
      level.common[node] = common;
    };
    parallel_for(level.count, fill_node, kNodesPerTask);
  }

  Common common_of(std::uint32_t i) const {
    Common common{
        .centers = {}, .min_radius = spheres_.radius(i), .max_radius = spheres_.radius(i)};
    common.centers.add(spheres_.opening(i), 0);
    common.centers.add(spheres_.closing(i), 0);
    return common;
  }

  /// The box is wider than the sphere by the max distance at which it touches another sphere.
  void add_sphere(Boxes& boxes, std::size_t place, std::uint32_t i) const {
    const double radius = spheres_.radius(i), unit = spheres_.extent();
    const double reach = (radius + gap_of_radius_ * radius + gap_) / unit + kFloatError;
    const Vec3 a = spheres_.opening(i) / unit, b = spheres_.closing(i) / unit;
    const std::array<std::array<double, 2>, 3> ends{{{a.x, b.x}, {a.y, b.y}, {a.z, b.z}}};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto [low, high] = std::minmax(ends[axis][0], ends[axis][1]);
      boxes.low[axis][place] = static_cast<float>(low - reach);
      boxes.high[axis][place] = static_cast<float>(high + reach);
    }
  }

  /// Finds pairs of a sphere of this leaf with a sphere of this leaf or a later one.
  void find(std::size_t leaf, std::vector<SpherePair>& found) {
    const std::size_t before = found.size();
    std::size_t comparisons = 0;
    struct Waiting {
      std::size_t level, node;
    };
    std::array<Waiting, kMaxLevels * kWidth> stack;
    std::size_t waiting = 0;
    stack[waiting++] = {levels_.size() - 1, 0};
    while (waiting > 0) {
      const Waiting now = stack[--waiting];
      if (now.level == 0) {
        comparisons += 1 + compare(leaf, now.node, found) / kTestsPerComparison;
        continue;
      }
      const Level &below = levels_[now.level - 1], &above_leaves = levels_[1];
      const std::size_t leaves_per_child = std::size_t{1} << 4 * (now.level - 1);
      std::uint32_t met =
          levels_[now.level].boxes[now.node].meet(above_leaves.boxes[leaf / kWidth], leaf % kWidth);
      for (; met != 0; met &= met - 1) {
        const std::size_t child =
            now.node * kWidth + static_cast<std::size_t>(std::countr_zero(met));
        const bool is_behind = (child + 1) * leaves_per_child > leaf;
        if (!is_behind || !may_be_near(levels_[0].common[leaf], below.common[child])) continue;
        stack[waiting++] = {now.level - 1, child};
      }
    }
    comparisons_ += comparisons;
    pairs_ += found.size() - before;
  }

  /// Returns the number of sphere tests.
  std::size_t compare(std::size_t leaf, std::size_t other, std::vector<SpherePair>& found) const {
    std::size_t tests = 0;
    const Boxes *ours = &levels_[0].boxes[leaf], *theirs = &levels_[0].boxes[other];
    std::uint32_t of_ours = Boxes::kAll, of_theirs = Boxes::kAll;
    if (leaf != other) {
      // Filter each leaf by the bounds of the other one; iterate over the leaf with fewer
      // candidates.
      const Level& above = levels_[1];
      of_theirs = theirs->meet(above.boxes[leaf / kWidth], leaf % kWidth);
      if (of_theirs == 0) return 0;
      of_ours = ours->meet(above.boxes[other / kWidth], other % kWidth);
      if (std::popcount(of_ours) < std::popcount(of_theirs)) {
        std::swap(ours, theirs);
        std::swap(of_ours, of_theirs);
        std::swap(leaf, other);
      }
    }
    for (; of_theirs != 0; of_theirs &= of_theirs - 1) {
      const auto k = static_cast<std::size_t>(std::countr_zero(of_theirs));
      const std::uint32_t among = leaf == other ? (1U << k) - 1 : of_ours;
      for (std::uint32_t met = ours->meet(*theirs, k, among); met != 0; met &= met - 1) {
        const auto l = static_cast<std::size_t>(std::countr_zero(met));
        const std::uint32_t a = order_[leaf * kWidth + l], b = order_[other * kWidth + k];
        if (are_near(a, b)) found.push_back({std::min(a, b), std::max(a, b)});
        ++tests;
      }
    }
    return tests;
  }

  /// Whether are_near() may hold for spheres below the two nodes, judged from their common bounds.
  /// This excludes most pairs even among concentric spheres, such as nested shells.
  bool may_be_near(const Common& a, const Common& b) const {
    double nearest_squared = 0, farthest_squared = 0;  // of centres
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double below = b.centers.low[axis] - a.centers.high[axis];
      const double above = a.centers.low[axis] - b.centers.high[axis];
      const double nearest = std::max({below, above, 0.0}), farthest = -std::min(below, above);
      nearest_squared += nearest * nearest;
      farthest_squared += farthest * farthest;
    }
    const double min_sum = a.min_radius + b.min_radius;
    const double max_sum = a.max_radius + b.max_radius;
    // Far more than the rounding errors of these values.
    const double gap = std::max(gap_, gap_of_radius_ * std::max(a.max_radius, b.max_radius)) +
                       kFloatError * spheres_.extent();
    const double reach = max_sum + gap, min_reach = std::max(min_sum - gap, 0.0);
    if (nearest_squared <= reach * reach && farthest_squared >= min_reach * min_reach) {
      return true;
    }
    const double nearest = std::sqrt(nearest_squared), farthest = std::sqrt(farthest_squared);
    const double min_difference =
        std::max({a.min_radius - b.max_radius, b.min_radius - a.max_radius, 0.0});
    const double max_difference =
        std::max(a.max_radius - b.min_radius, b.max_radius - a.min_radius);
    return (nearest <= max_difference + gap && farthest >= min_difference - gap) ||
           nearest + min_difference <= spread_ + gap;
  }

  bool are_near(std::uint32_t a, std::uint32_t b) const {
    const double of_a = spheres_.radius(a), of_b = spheres_.radius(b);
    const double sum = of_a + of_b, difference = std::fabs(of_a - of_b);
    const double gap = std::max(gap_, gap_of_radius_ * std::max(of_a, of_b));
    const Vec3 from = spheres_.opening(a) - spheres_.opening(b);
    double nearest = length(from), farthest = nearest;
    if (spheres_.is_moving()) {
      const Vec3 to = spheres_.closing(a) - spheres_.closing(b), way = to - from;
      if (length(way) * kBriefly > std::max(gap, spread_)) return false;
      farthest = std::max(nearest, length(to));
      nearest = length(from + way * nearest_moment(from, way));
    }
    const auto reaches = [&](double distance) {
      return nearest <= distance + gap && farthest >= distance - gap;
    };
    const bool overlap = nearest <= sum;
    return reaches(sum) || reaches(difference) || (overlap && nearest + difference <= spread_);
  }

  static constexpr std::size_t kMaxLevels = 9;  // for 2^32 spheres

  const Crowd& spheres_;
  double gap_, gap_of_radius_, spread_;
  std::vector<std::uint32_t> order_;
  std::vector<Level> levels_;
  std::atomic<std::size_t> comparisons_ = 0, pairs_ = 0;  // so far
  std::size_t max_comparisons_ = 0, max_pairs_ = 0;
};

}  // namespace

std::optional<std::vector<SpherePair>> find_near_pairs(const CameraView& view,
                                                       const Nearness& nearness,
                                                       std::span<const std::uint32_t> left_out) {
  const Crowd spheres(view, left_out);
  if (spheres.size() > kFewSpheres) return Search(spheres, nearness).run();
  std::vector<std::uint32_t> visible;
  for (std::uint32_t i = 0; i < spheres.count(); ++i) {
    if (spheres.has(i)) visible.push_back(i);
  }
  std::vector<SpherePair> pairs;
  for (std::size_t k = 0; k < visible.size(); ++k) {
    for (std::size_t l = k + 1; l < visible.size(); ++l) pairs.push_back({visible[k], visible[l]});
  }
  return pairs;
}

}  // namespace sdlc::render
