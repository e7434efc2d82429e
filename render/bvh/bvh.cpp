#include "render/bvh/bvh.hpp"

#include <algorithm>
#include <cmath>

#include "render/math/box.hpp"

namespace sdlc::render {
/// Builds the nodes top-down over an array of references, which it sorts in place.
class BvhBuilder {
 public:
  BvhBuilder(Bvh& bvh, std::span<const Sphere> spheres, std::span<const Vec3> shifts)
      : bvh_(bvh), spheres_(spheres), shifts_(shifts) {}

  void build() {
    references_.resize(spheres_.size());
    for (std::uint32_t i = 0; i < references_.size(); ++i) references_[i] = reference(i);
    if (!references_.empty()) bvh_.root_ = build_child(0, references_.size(), 0);
    store_spheres();
  }

 private:
  static constexpr std::size_t kBins = 16;
  static constexpr std::size_t kMaxLeaf = 8;
  // The cost of visiting a node, in units of a sphere test. Of .5 to 6, tried on scenes of 20, 485
  // and 10^5 spheres, 3 and 6 were 2 to 12 % faster than 1 everywhere.
  static constexpr double kNodeCost = 3.0;
  // Below this depth nodes are split in halves instead of by the surface area heuristic, so that
  // kMaxDepth holds.
  static constexpr int kMaxSahDepth = 60;

  struct Reference {
    Box bounds;
    std::uint32_t index;

    /// Twice the centroid.
    double centroid(std::size_t axis) const noexcept {
      return bounds.low[axis] + bounds.high[axis];
    }
  };

  struct Split {
    double cost = Box::kInfinity;
    std::size_t axis = 0;
    std::size_t bin = 0;  // spheres of bins up to this one go to the first child
  };

  /// Maps a centroid to a bin; the centroids of the range are in [low, low + size].
  struct Bins {
    double low = 0, scale = 0;

    std::size_t operator()(double centroid) const noexcept {
      const auto bin = static_cast<std::size_t>((centroid - low) * scale);
      return std::min(bin, kBins - 1);
    }
  };

  Reference reference(std::uint32_t i) const {
    Reference reference{.bounds = {}, .index = i};
    const Sphere& sphere = spheres_[i];
    reference.bounds.add(sphere.center, sphere.radius);
    if (!shifts_.empty()) reference.bounds.add(sphere.center + shifts_[i], sphere.radius);
    return reference;
  }

  Bvh::Child build_child(std::size_t begin, std::size_t end, int depth) {
    const std::size_t count = end - begin;
    const auto leaf = Bvh::Child{.first = static_cast<std::uint32_t>(begin),
                                 .count = static_cast<std::uint32_t>(count)};
    if (count == 1) return leaf;

    std::size_t mid = begin + count / 2;
    if (depth < kMaxSahDepth) {
      std::array<Bins, 3> bins;
      const Split split = best_split(begin, end, bins);
      if (count <= kMaxLeaf && !(split.cost < static_cast<double>(count))) return leaf;
      if (split.cost < Box::kInfinity) {
        const auto first = references_.begin() + static_cast<std::ptrdiff_t>(begin);
        const auto last = references_.begin() + static_cast<std::ptrdiff_t>(end);
        const auto cut = std::partition(first, last, [&](const Reference& r) {
          return bins[split.axis](r.centroid(split.axis)) <= split.bin;
        });
        mid = static_cast<std::size_t>(cut - references_.begin());
      }  // otherwise all centroids coincide, and any halves will do
    } else if (count <= kMaxLeaf) {
      return leaf;
    }

    const auto node = static_cast<std::uint32_t>(bvh_.nodes_.size());
    bvh_.nodes_.emplace_back();
    const Box first_bounds = bounds(begin, mid), second_bounds = bounds(mid, end);
    const Bvh::Child first = build_child(begin, mid, depth + 1);
    const Bvh::Child second = build_child(mid, end, depth + 1);
    store_node(bvh_.nodes_[node], first_bounds, second_bounds);
    bvh_.nodes_[node].children = {first, second};
    return {.first = node, .count = 0};
  }

  Split best_split(std::size_t begin, std::size_t end, std::array<Bins, 3>& bins) const {
    Split best;
    const double area = bounds(begin, end).half_area();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      double low = Box::kInfinity, high = -Box::kInfinity;
      for (std::size_t i = begin; i < end; ++i) {
        low = std::min(low, references_[i].centroid(axis));
        high = std::max(high, references_[i].centroid(axis));
      }
      if (!(high > low)) continue;
      bins[axis] = {.low = low, .scale = kBins / (high - low)};
      if (!std::isfinite(bins[axis].scale)) continue;  // centroids a subnormal distance apart

      std::array<Box, kBins> bin_bounds;
      std::array<std::size_t, kBins> counts{};
      for (std::size_t i = begin; i < end; ++i) {
        const std::size_t bin = bins[axis](references_[i].centroid(axis));
        bin_bounds[bin].add(references_[i].bounds);
        ++counts[bin];
      }
      std::array<double, kBins> cost_above{};
      Box above;
      std::size_t count_above = 0;
      for (std::size_t bin = kBins - 1; bin > 0; --bin) {
        above.add(bin_bounds[bin]);
        count_above += counts[bin];
        cost_above[bin - 1] =
            count_above > 0 ? above.half_area() * static_cast<double>(count_above) : 0;
      }
      Box below;
      std::size_t count_below = 0;
      for (std::size_t bin = 0; bin + 1 < kBins; ++bin) {
        below.add(bin_bounds[bin]);
        count_below += counts[bin];
        if (count_below == 0 || count_below == end - begin) continue;
        const double cost =
            kNodeCost +
            (below.half_area() * static_cast<double>(count_below) + cost_above[bin]) / area;
        if (cost < best.cost) best = {.cost = cost, .axis = axis, .bin = bin};
      }
    }
    return best;
  }

  Box bounds(std::size_t begin, std::size_t end) const {
    Box all;
    for (std::size_t i = begin; i < end; ++i) all.add(references_[i].bounds);
    return all;
  }

  /// Widens the boxes by more than the rounding errors of both tests, so that a ray which hits a
  /// sphere also hits its box. The extent of a rebased scene is at most 2.
  static void store_node(Bvh::Node& node, const Box& first, const Box& second) {
    constexpr double kMargin = 0x1p-44;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      node.bounds[axis][0] = Bvh::Pair{first.low[axis] - kMargin, second.low[axis] - kMargin};
      node.bounds[axis][1] = Bvh::Pair{first.high[axis] + kMargin, second.high[axis] + kMargin};
    }
  }

  void store_spheres() {
    bvh_.spheres_.reserve(references_.size());
    bvh_.indices_.reserve(references_.size());
    if (!shifts_.empty()) bvh_.shifts_.reserve(references_.size());
    for (const Reference& reference : references_) {
      const Sphere& sphere = spheres_[reference.index];
      bvh_.spheres_.push_back({.center = sphere.center, .radius = sphere.radius});
      bvh_.indices_.push_back(reference.index);
      if (!shifts_.empty()) bvh_.shifts_.push_back(shifts_[reference.index]);
    }
  }

  Bvh& bvh_;
  std::span<const Sphere> spheres_;
  std::span<const Vec3> shifts_;
  std::vector<Reference> references_;
};

Bvh::Bvh(std::span<const Sphere> spheres, std::span<const Vec3> shifts) {
  BvhBuilder(*this, spheres, shifts).build();
}

std::size_t Bvh::memory_bytes() const noexcept {
  return nodes_.capacity() * sizeof(Node) + spheres_.capacity() * sizeof(BvhSphere) +
         shifts_.capacity() * sizeof(Vec3) + indices_.capacity() * sizeof(std::uint32_t);
}

std::size_t Bvh::estimated_bytes(std::size_t spheres, bool is_moving) noexcept {
  // Leaves hold several spheres: between .14 and .40 nodes per sphere were counted, on scenes from
  // concentric to sparse spheres. The vector of nodes grows by doubling.
  constexpr std::size_t kSpheresPerNode = 3;
  return spheres / kSpheresPerNode * sizeof(Node) +
         spheres * (sizeof(BvhSphere) + sizeof(std::uint32_t) + (is_moving ? sizeof(Vec3) : 0));
}

}  // namespace sdlc::render
