#include "render/scene/near_pairs.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <utility>

#include <tbb/parallel_for.h>

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

#include "render/math/box.hpp"
#include "render/math/vec3.hpp"
#include "render/scene/curve_order.hpp"
#include "render/scene/movement.hpp"

namespace sdlc::render {
namespace {

constexpr std::size_t kWidth = 16;  // spheres of a leaf, boxes of a node
// What rounding places, radii and distances to float may add to a distance, in extents: 16 u.
constexpr double kFloatError = 0x1p-20;

/// Sixteen boxes, or where spheres are, side by side.
class Boxes {
 public:
  static constexpr std::uint32_t kAll = 0xFFFF;

  std::array<std::array<float, kWidth>, 3> low, high;

  /// Empty ones are met by none.
  void clear() {
    for (auto& axis : low) axis.fill(std::numeric_limits<float>::infinity());
    for (auto& axis : high) axis.fill(-std::numeric_limits<float>::infinity());
  }
  /// Puts one around all of `other` at a place.
  void add(std::size_t place, const Boxes& other) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      Four least = four(other.low[axis], 0), most = four(other.high[axis], 0);
      for (std::size_t first = 4; first < kWidth; first += 4) {
        const Four lows = four(other.low[axis], first), highs = four(other.high[axis], first);
        least = lows < least ? lows : least;
        most = highs > most ? highs : most;
      }
      low[axis][place] = std::min({least[0], least[1], least[2], least[3]});
      high[axis][place] = std::max({most[0], most[1], most[2], most[3]});
    }
  }
  /// Those `among` which the box at `place` of `other` meets, as bits.
  std::uint32_t meet(const Boxes& other, std::size_t place, std::uint32_t among = kAll) const {
    std::uint32_t met = 0;
    for (std::size_t first = 0; first < kWidth; first += 4) {
      if ((among >> first & 0xF) == 0) continue;
      auto is_met = four(low[0], first) <= other.high[0][place];
      is_met &= other.low[0][place] <= four(high[0], first);
      for (std::size_t axis = 1; axis < 3; ++axis) {
        is_met &= four(low[axis], first) <= other.high[axis][place];
        is_met &= other.low[axis][place] <= four(high[axis], first);
      }
      met |= bits_of(is_met) << first;
    }
    return met & among;
  }

 private:
  using Four = float __attribute__((vector_size(16)));
  using FourBits = std::int32_t __attribute__((vector_size(16)));

  static Four four(const std::array<float, kWidth>& row, std::size_t first) {
    Four v;
    std::memcpy(&v, row.data() + first, sizeof v);
    return v;
  }
  static std::uint32_t bits_of(FourBits v) {
#if defined(__SSE2__)
    return static_cast<std::uint32_t>(_mm_movemask_ps(reinterpret_cast<__m128>(v)));
#else
    return static_cast<std::uint32_t>((v[0] & 1) | (v[1] & 2) | (v[2] & 4) | (v[3] & 8));
#endif
  }
};

/// What the spheres of a leaf, or below a node, have in common: where their centres are while the
/// shutter is open, and their radii.
struct Common {
  Box centers;
  double least_radius = Box::kInfinity, most_radius = 0;

  void add(const Common& other) {
    centers.add(other.centers);
    least_radius = std::min(least_radius, other.least_radius);
    most_radius = std::max(most_radius, other.most_radius);
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
    const std::size_t parts = (leaves + kLeavesAPart - 1) / kLeavesAPart;
    most_comparisons_ = kMostComparisons + 100 * leaves;
    most_pairs_ = kMostPairs + kMaxPairsPerSphere * order_.size();
    std::vector<std::vector<SpherePair>> found(parts);
    tbb::parallel_for(std::size_t{0}, parts, [&](std::size_t part) {
      const std::size_t end = std::min(leaves, (part + 1) * kLeavesAPart);
      for (std::size_t leaf = part * kLeavesAPart; leaf < end && !is_too_much(); ++leaf) {
        find(leaf, found[part]);
      }
    });
    if (is_too_much()) return std::nullopt;
    std::vector<SpherePair> pairs;
    for (const auto& of_part : found) pairs.insert(pairs.end(), of_part.begin(), of_part.end());
    return pairs;
  }

 private:
  static constexpr std::size_t kLeavesAPart = 256;
  // Of leaves, beside a hundred for each, where scenes need some twenty.
  static constexpr std::size_t kMostComparisons = 1 << 17;
  static constexpr std::size_t kMostPairs = 1 << 20;
  static constexpr std::size_t kMaxPairsPerSphere = 24;  // of a lattice that touches 6
  // Tests of two spheres that take as long as a comparison of two leaves without any.
  static constexpr std::size_t kTestsPerComparison = 16;

  /// Whether there is more to do than may be: sums that only grow, so that no thread's pace
  /// decides.
  bool is_too_much() const { return comparisons_ > most_comparisons_ || pairs_ > most_pairs_; }

  /// Nodes of one height: those at the bottom are leaves, with the boxes of their spheres; those of
  /// each level above have sixteen nodes of the one below.
  struct Level {
    // Not initialised: the threads that fill them touch their memory first.
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

  /// `add(boxes, place, k)` puts each of `count` where it belongs in a node, and says what it has
  /// in common with the others there.
  template <typename Add>
  static void fill(Level& level, std::size_t count, const Add& add) {
    tbb::parallel_for(std::size_t{0}, level.count, [&](std::size_t node) {
      level.boxes[node].clear();
      Common common;
      const std::size_t end = std::min(count, (node + 1) * kWidth);
      for (std::size_t k = node * kWidth; k < end; ++k) {
        common.add(add(level.boxes[node], k % kWidth, k));
      }
      level.common[node] = common;
    });
  }

  Common common_of(std::uint32_t i) const {
    Common common{
        .centers = {}, .least_radius = spheres_.radius(i), .most_radius = spheres_.radius(i)};
    common.centers.add(spheres_.opening(i), 0);
    common.centers.add(spheres_.closing(i), 0);
    return common;
  }

  /// Wider than the sphere by as much as it may be from another one that it touches.
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

  /// Pairs with a sphere of the leaf and one of it or of those behind it.
  void find(std::size_t leaf, std::vector<SpherePair>& found) {
    const std::size_t before = found.size();
    std::size_t comparisons = 0;
    struct Waiting {
      std::size_t level, node;
    };
    std::array<Waiting, kMostLevels * kWidth> stack;
    std::size_t waiting = 0;
    stack[waiting++] = {levels_.size() - 1, 0};
    while (waiting > 0) {
      const Waiting now = stack[--waiting];
      if (now.level == 0) {
        comparisons += 1 + compare(leaf, now.node, found) / kTestsPerComparison;
        continue;
      }
      const Level &below = levels_[now.level - 1], &above_leaves = levels_[1];
      const std::size_t leaves_a_child = std::size_t{1} << 4 * (now.level - 1);
      std::uint32_t met =
          levels_[now.level].boxes[now.node].meet(above_leaves.boxes[leaf / kWidth], leaf % kWidth);
      for (; met != 0; met &= met - 1) {
        const std::size_t child =
            now.node * kWidth + static_cast<std::size_t>(std::countr_zero(met));
        const bool is_behind = (child + 1) * leaves_a_child > leaf;
        if (!is_behind || !may_be_near(levels_[0].common[leaf], below.common[child])) continue;
        stack[waiting++] = {now.level - 1, child};
      }
    }
    comparisons_ += comparisons;
    pairs_ += found.size() - before;
  }

  /// How many pairs of spheres it had to test.
  std::size_t compare(std::size_t leaf, std::size_t other, std::vector<SpherePair>& found) const {
    std::size_t tests = 0;
    const Boxes *ours = &levels_[0].boxes[leaf], *theirs = &levels_[0].boxes[other];
    std::uint32_t of_ours = Boxes::kAll, of_theirs = Boxes::kAll;
    if (leaf != other) {
      // Of each leaf those that meet the box around the other one; the fewer are looked at in turn.
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

  /// Whether are_near() may hold for a sphere of each, by what they have in common: of many spheres
  /// around one place, as of nested shells, it does for few.
  bool may_be_near(const Common& a, const Common& b) const {
    double nearest_squared = 0, farthest_squared = 0;  // centres
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double below = b.centers.low[axis] - a.centers.high[axis];
      const double above = a.centers.low[axis] - b.centers.high[axis];
      const double nearest = std::max({below, above, 0.0}), farthest = -std::min(below, above);
      nearest_squared += nearest * nearest;
      farthest_squared += farthest * farthest;
    }
    const double least_sum = a.least_radius + b.least_radius;
    const double most_sum = a.most_radius + b.most_radius;
    // Far more than rounding does to any of these.
    const double gap = std::max(gap_, gap_of_radius_ * std::max(a.most_radius, b.most_radius)) +
                       kFloatError * spheres_.extent();
    const double reach = most_sum + gap, least_reach = std::max(least_sum - gap, 0.0);
    if (nearest_squared <= reach * reach && farthest_squared >= least_reach * least_reach) {
      return true;
    }
    const double nearest = std::sqrt(nearest_squared), farthest = std::sqrt(farthest_squared);
    const double least_difference =
        std::max({a.least_radius - b.most_radius, b.least_radius - a.most_radius, 0.0});
    const double most_difference =
        std::max(a.most_radius - b.least_radius, b.most_radius - a.least_radius);
    return (nearest <= most_difference + gap && farthest >= least_difference - gap) ||
           nearest + least_difference <= spread_ + gap;
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

  static constexpr std::size_t kMostLevels = 9;  // of 2^32 spheres

  const Crowd& spheres_;
  double gap_, gap_of_radius_, spread_;
  std::vector<std::uint32_t> order_;
  std::vector<Level> levels_;
  std::atomic<std::size_t> comparisons_ = 0, pairs_ = 0;  // so far
  std::size_t most_comparisons_ = 0, most_pairs_ = 0;
};

}  // namespace

std::optional<std::vector<SpherePair>> find_near_pairs(const CameraView& view,
                                                       const Nearness& nearness,
                                                       std::span<const std::uint32_t> left_out) {
  const Crowd spheres(view, left_out);
  if (spheres.size() > kFewSpheres) return Search(spheres, nearness).run();
  std::vector<std::uint32_t> members;
  for (std::uint32_t i = 0; i < spheres.count(); ++i) {
    if (spheres.has(i)) members.push_back(i);
  }
  std::vector<SpherePair> pairs;
  for (std::size_t k = 0; k < members.size(); ++k) {
    for (std::size_t l = k + 1; l < members.size(); ++l) pairs.push_back({members[k], members[l]});
  }
  return pairs;
}

}  // namespace sdlc::render
