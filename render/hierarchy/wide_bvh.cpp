#include "render/hierarchy/wide_bvh.hpp"

#include <algorithm>
#include <memory>
#include <vector>

#include "render/hierarchy/binned_split.hpp"
#include "render/hierarchy/build_primitives.hpp"
#include "render/hierarchy/grid_split.hpp"
#include "render/hierarchy/sweep_split.hpp"
#include "render/math/vec3.hpp"
#include "render/parallel/parallel_for.hpp"

namespace sdlc::render {
namespace {

/// Added to boxes on each side, in a scene of extent 2. It far exceeds the rounding errors of the
/// box itself and, perpendicular to the ray, of the box and sphere tests for rays that start within
/// the scene: about u · 2 in float, where the precision criterion keeps radii above 2500 u · 2. The
/// search itself allows for errors along the ray and for rays that start far away.
template <typename T>
constexpr T kMargin = sizeof(T) == 4 ? T(0x1.1p-18) : T(0x1.1p-44);

template <typename T>
using Node = typename WideBvh<T>::Node;

/// A part of the BVH, with node and leaf indices relative to its own start.
template <typename T>
struct Subtree {
  std::vector<Node<T>> nodes;  ///< root first; empty if the subtree is a leaf
  std::vector<std::uint32_t> slots;
  /// If threads share the work: the children of the only node.
  std::vector<Subtree> children;
};

template <typename T>
void store_box(const BuildBox<T>& box, std::size_t child, Node<T>& node) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    node.bounds[axis][0][child] = box.low(axis) - kMargin<T>;
    node.bounds[axis][1][child] = box.high(axis) + kMargin<T>;
  }
}

template <typename T>
void store_no_box(std::size_t child, Node<T>& node) {
  constexpr T kFar{1e15F};  // its product with any inverse direction is finite
  for (std::size_t axis = 0; axis < 3; ++axis) {
    node.bounds[axis][0][child] = kFar;
    node.bounds[axis][1][child] = -kFar;
  }
}

/// Splits the primitives into ranges, top-down, and builds nodes and leaves.
template <typename T>
class Builder {
 public:
  explicit Builder(std::span<Primitive<T>> primitives)
      : primitives_(primitives), sweep_(primitives) {}

  /// `source(i)` returns primitive i.
  template <typename Source>
  Subtree<T> build(const Source& source) {
    Subtree<T> tree;
    if (primitives_.size() > kMaxSequential) {
      const auto ranges = GridSplit<T, Source>(source, primitives_.size()).split(primitives_, 0);
      build_shared(divided(ranges, 0), 0, tree);
      return tree;
    }
    Range<T> all{.begin = 0, .end = primitives_.size(), .box = {}};
    for (std::size_t i = 0; i < primitives_.size(); ++i) {
      primitives_[i] = source(i);
      all.box.add(primitives_[i].box());
    }
    build_node(all, 0, tree);
    return tree;
  }

 private:
  // Below this depth ranges are halved, to limit the size of the traversal stack.
  static constexpr int kMaxSahDepth = 24;
  // Larger ranges are divided, and the nodes above them built, by all threads.
  static constexpr std::size_t kMaxSequential = 32768;
  static constexpr std::size_t kCopiedPerTask = 4096;

  NodeRanges<T> children_of(const Range<T>& whole, int depth) {
    NodeRanges<T> ranges{.of = {whole}, .count = 1};
    while (ranges.count < kBvhWidth) {
      // The largest box first, because most rays hit it.
      const auto area = [](const Range<T>& g) { return g.is_leaf() ? T{-1} : g.box.half_area(); };
      const auto largest = std::max_element(
          ranges.of.begin(), ranges.of.begin() + static_cast<std::ptrdiff_t>(ranges.count),
          [&](const Range<T>& a, const Range<T>& b) { return area(a) < area(b); });
      if (largest->is_leaf()) break;
      const auto parts = depth < kMaxSahDepth ? split(*largest) : halves(*largest);
      *largest = parts[0];
      ranges.of[ranges.count++] = parts[1];
    }
    return ranges;
  }

  std::array<Range<T>, 2> split(const Range<T>& whole) {
    if (whole.count() <= SweepSplitter<T>::kMaxSwept) return sweep_.split(whole);
    return split_by_bins(primitives_, whole);
  }

  std::array<Range<T>, 2> halves(const Range<T>& whole) {
    if (whole.is_sorted()) return sweep_.split_in_halves(whole);
    return split_in_halves<T>(primitives_, whole);
  }

  /// Appends the node and its subtree.
  std::uint32_t build_node(const Range<T>& whole, int depth, Subtree<T>& tree) {
    const auto index = static_cast<std::uint32_t>(tree.nodes.size());
    tree.nodes.emplace_back();
    const NodeRanges<T> ranges = children_of(whole, depth);
    std::array<std::uint32_t, kBvhWidth> children{};
    for (std::size_t i = 0; i < ranges.count; ++i) {
      const Range<T>& range = ranges.of[i];
      children[i] = range.is_leaf() ? add_leaf(range, tree) : build_node(range, depth + 1, tree);
    }
    store_node(ranges, children, tree.nodes[index]);
    return index;
  }

  /// Falls back to children_of() if the grid could not divide the range because all centroids
  /// coincide.
  NodeRanges<T> divided(const NodeRanges<T>& ranges, int depth) {
    return ranges.count > 1 ? ranges : children_of(ranges.of[0], depth);
  }

  NodeRanges<T> divide(const Range<T>& whole, int depth) {
    if (depth >= kMaxSahDepth) return children_of(whole, depth);
    const std::size_t count = whole.count();
    const auto copies = std::make_unique_for_overwrite<Primitive<T>[]>(count);  // NOLINT
    parallel_ranges(count, kCopiedPerTask, [&](std::size_t begin, std::size_t end) {
      const auto from = primitives_.subspan(whole.begin + begin, end - begin);
      std::copy(from.begin(), from.end(), copies.get() + begin);
    });
    const auto source = [&](std::size_t i) -> const Primitive<T>& { return copies[i]; };
    return divided(GridSplit<T, decltype(source)>(source, count).split(primitives_, whole.begin),
                   depth);
  }

  /// A node whose children are separate subtrees, built in parallel.
  void build_shared(const NodeRanges<T>& ranges, int depth, Subtree<T>& tree) {
    tree.nodes.resize(1);
    tree.children.resize(ranges.count);
    store_node(ranges, {}, tree.nodes[0]);
    parallel_for(ranges.count, [&](std::size_t i) {
      const Range<T>& range = ranges.of[i];
      if (range.is_leaf()) {
        add_leaf(range, tree.children[i]);
      } else if (range.count() > kMaxSequential) {
        build_shared(divide(range, depth + 1), depth + 1, tree.children[i]);
      } else {
        build_node(range, depth + 1, tree.children[i]);
      }
    });
  }

  static void store_node(const NodeRanges<T>& ranges,
                         const std::array<std::uint32_t, kBvhWidth>& children, Node<T>& node) {
    for (std::size_t i = 0; i < ranges.count; ++i) store_box<T>(ranges.of[i].box, i, node);
    for (std::size_t i = ranges.count; i < kBvhWidth; ++i) store_no_box<T>(i, node);
    node.children = children;
  }

  std::uint32_t add_leaf(const Range<T>& range, Subtree<T>& tree) const {
    const std::size_t first = tree.slots.size();
    tree.slots.resize(first + kBvhWidth, WideBvh<T>::kNoSphere);
    const auto begin = tree.slots.begin() + static_cast<std::ptrdiff_t>(first);
    auto end = begin;
    for (std::size_t i = range.begin; i < range.end; ++i) *end++ = sweep_.sphere_at(range, i);
    std::sort(begin, end);
    return static_cast<std::uint32_t>(first / kBvhWidth) | WideBvh<T>::kLeaf;
  }

  std::span<Primitive<T>> primitives_;
  SweepSplitter<T> sweep_;
};

/// Concatenates subtrees, each node before its descendants.
template <typename T>
class Splicer {
 public:
  explicit Splicer(Subtree<T>& root) { place(root); }

  void write_to(WideBvh<T>& bvh) {
    bvh.nodes.resize(nodes_);
    bvh.slots.resize(leaves_ * kBvhWidth);
    parallel_for(places_.size(), [&](std::size_t i) { write(places_[i], bvh); });
  }

 private:
  struct Place {
    Subtree<T>* tree;
    std::uint32_t first_node, first_leaf;
  };

  /// Returns the child reference of this subtree.
  std::uint32_t place(Subtree<T>& tree) {
    const Place here{.tree = &tree, .first_node = nodes_, .first_leaf = leaves_};
    places_.push_back(here);
    nodes_ += static_cast<std::uint32_t>(tree.nodes.size());
    leaves_ += static_cast<std::uint32_t>(tree.slots.size() / kBvhWidth);
    for (std::size_t i = 0; i < tree.children.size(); ++i) {
      tree.nodes[0].children[i] = place(tree.children[i]);
    }
    return tree.nodes.empty() ? here.first_leaf | WideBvh<T>::kLeaf : here.first_node;
  }

  static void write(const Place& place, WideBvh<T>& bvh) {
    Subtree<T>& tree = *place.tree;
    if (tree.children.empty()) {
      for (Node<T>& node : tree.nodes) {
        for (std::uint32_t& child : node.children) {
          // 0, the root, marks a missing child.
          if (child != 0)
            child += (child & WideBvh<T>::kLeaf) != 0 ? place.first_leaf : place.first_node;
        }
      }
    }
    std::copy(tree.nodes.begin(), tree.nodes.end(), bvh.nodes.begin() + place.first_node);
    std::copy(tree.slots.begin(), tree.slots.end(),
              bvh.slots.begin() + static_cast<std::ptrdiff_t>(place.first_leaf * kBvhWidth));
    tree.nodes = {};
    tree.slots = {};
  }

  std::vector<Place> places_;
  std::uint32_t nodes_ = 0, leaves_ = 0;
};

template <typename T>
Primitive<T> primitive_of(const Scene& scene, std::uint32_t index) {
  const Sphere& sphere = scene.spheres[index];
  Primitive<T> primitive(sphere.center, sphere.radius, index);
  if (!scene.shifts.empty()) {
    primitive.add({sphere.center + scene.shifts[index], sphere.radius, index});
  }
  return primitive;
}

}  // namespace

template <typename T>
WideBvh<T>::WideBvh(const Scene& scene, std::span<const std::uint32_t> spheres) {
  if (spheres.empty()) return;
  Subtree<T> tree;
  {
    const auto primitives =
        std::make_unique_for_overwrite<Primitive<T>[]>(spheres.size());  // NOLINT
    const auto source = [&](std::size_t i) { return primitive_of<T>(scene, spheres[i]); };
    tree = Builder<T>({primitives.get(), spheres.size()}).build(source);
  }
  Splicer<T>(tree).write_to(*this);
}

template struct WideBvh<float>;
template struct WideBvh<double>;

}  // namespace sdlc::render
