#include "render/wide/wide_bvh.hpp"

#include <algorithm>
#include <memory>
#include <vector>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>

#include "render/math/vec3.hpp"
#include "render/wide/binned_split.hpp"
#include "render/wide/bvh_members.hpp"
#include "render/wide/grid_split.hpp"
#include "render/wide/sweep_split.hpp"

namespace sdlc::render {
namespace {

/// Of boxes, on each side, in a scene of extent 2. It exceeds by far what rounding does to the box
/// itself and, across the ray, to the tests of box and sphere, for rays that begin within the
/// scene: some u · 2 in float, where the criterion of precision keeps radii above 2500 u · 2. What
/// it does along the ray, and to those that come from far away, is the search's to allow for.
template <typename T>
constexpr T kMargin = sizeof(T) == 4 ? T(0x1.1p-18) : T(0x1.1p-44);

template <typename T>
using Node = typename WideBvh<T>::Node;

/// Part of a hierarchy, which counts nodes and leaves from its own first ones.
template <typename T>
struct Subtree {
  std::vector<Node<T>> nodes;  ///< the root first; none where the subtree is a leaf
  std::vector<std::uint32_t> slots;
  /// Below the only node, where threads share the work: its children.
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
  constexpr T kFar{1e15F};  // its products with any inverse of a direction are finite
  for (std::size_t axis = 0; axis < 3; ++axis) {
    node.bounds[axis][0][child] = kFar;
    node.bounds[axis][1][child] = -kFar;
  }
}

/// Splits the members into groups, top-down, and these into nodes and leaves.
template <typename T>
class Builder {
 public:
  explicit Builder(std::span<Member<T>> members) : members_(members), sweep_(members) {}

  /// `source(i)` gives each of the members.
  template <typename Source>
  Subtree<T> build(const Source& source) {
    Subtree<T> tree;
    if (members_.size() > kMostAlone) {
      const auto groups = GridSplit<T, Source>(source, members_.size()).split(members_, 0);
      build_shared(divided(groups, 0), 0, tree);
      return tree;
    }
    Group<T> all{.begin = 0, .end = members_.size(), .box = {}};
    for (std::size_t i = 0; i < members_.size(); ++i) {
      members_[i] = source(i);
      all.box.add(members_[i].box());
    }
    build_node(all, 0, tree);
    return tree;
  }

 private:
  // So deep, groups are halved: the nodes that wait while a ray is followed have to find room.
  static constexpr int kMostSahDepth = 24;
  // Groups of more members are divided, and nodes above them built, by all threads.
  static constexpr std::size_t kMostAlone = 32768;
  static constexpr std::size_t kCopiedAtATime = 4096;

  NodeGroups<T> children_of(const Group<T>& whole, int depth) {
    NodeGroups<T> groups{.of = {whole}, .count = 1};
    while (groups.count < kBvhWidth) {
      // The largest box first: it is what most rays meet.
      const auto area = [](const Group<T>& g) { return g.is_leaf() ? T{-1} : g.box.half_area(); };
      const auto largest = std::max_element(
          groups.of.begin(), groups.of.begin() + static_cast<std::ptrdiff_t>(groups.count),
          [&](const Group<T>& a, const Group<T>& b) { return area(a) < area(b); });
      if (largest->is_leaf()) break;
      const auto parts = depth < kMostSahDepth ? split(*largest) : halves(*largest);
      *largest = parts[0];
      groups.of[groups.count++] = parts[1];
    }
    return groups;
  }

  std::array<Group<T>, 2> split(const Group<T>& whole) {
    if (whole.count() <= SweepSplitter<T>::kMostSwept) return sweep_.split(whole);
    return split_by_bins(members_, whole);
  }

  std::array<Group<T>, 2> halves(const Group<T>& whole) {
    if (whole.is_sorted()) return sweep_.split_in_halves(whole);
    return split_in_halves<T>(members_, whole);
  }

  /// Appends the node and all below it.
  std::uint32_t build_node(const Group<T>& whole, int depth, Subtree<T>& tree) {
    const auto index = static_cast<std::uint32_t>(tree.nodes.size());
    tree.nodes.emplace_back();
    const NodeGroups<T> groups = children_of(whole, depth);
    std::array<std::uint32_t, kBvhWidth> children{};
    for (std::size_t i = 0; i < groups.count; ++i) {
      const Group<T>& group = groups.of[i];
      children[i] = group.is_leaf() ? add_leaf(group, tree) : build_node(group, depth + 1, tree);
    }
    store_node(groups, children, tree.nodes[index]);
    return index;
  }

  /// What becomes of groups that were divided: where all middles are in one place, they were not.
  NodeGroups<T> divided(const NodeGroups<T>& groups, int depth) {
    return groups.count > 1 ? groups : children_of(groups.of[0], depth);
  }

  NodeGroups<T> divide(const Group<T>& whole, int depth) {
    if (depth >= kMostSahDepth) return children_of(whole, depth);
    const std::size_t count = whole.count();
    const auto copies = std::make_unique_for_overwrite<Member<T>[]>(count);  // NOLINT
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, kCopiedAtATime),
                      [&](const tbb::blocked_range<std::size_t>& range) {
                        const auto from =
                            members_.subspan(whole.begin + range.begin(), range.size());
                        std::copy(from.begin(), from.end(), copies.get() + range.begin());
                      });
    const auto source = [&](std::size_t i) -> const Member<T>& { return copies[i]; };
    return divided(GridSplit<T, decltype(source)>(source, count).split(members_, whole.begin),
                   depth);
  }

  /// A node whose children are subtrees of their own, built at the same time.
  void build_shared(const NodeGroups<T>& groups, int depth, Subtree<T>& tree) {
    tree.nodes.resize(1);
    tree.children.resize(groups.count);
    store_node(groups, {}, tree.nodes[0]);
    tbb::parallel_for(std::size_t{0}, groups.count, [&](std::size_t i) {
      const Group<T>& group = groups.of[i];
      if (group.is_leaf()) {
        add_leaf(group, tree.children[i]);
      } else if (group.count() > kMostAlone) {
        build_shared(divide(group, depth + 1), depth + 1, tree.children[i]);
      } else {
        build_node(group, depth + 1, tree.children[i]);
      }
    });
  }

  static void store_node(const NodeGroups<T>& groups,
                         const std::array<std::uint32_t, kBvhWidth>& children, Node<T>& node) {
    for (std::size_t i = 0; i < groups.count; ++i) store_box<T>(groups.of[i].box, i, node);
    for (std::size_t i = groups.count; i < kBvhWidth; ++i) store_no_box<T>(i, node);
    node.children = children;
  }

  std::uint32_t add_leaf(const Group<T>& group, Subtree<T>& tree) const {
    const std::size_t first = tree.slots.size();
    tree.slots.resize(first + kBvhWidth, WideBvh<T>::kNoSphere);
    const auto begin = tree.slots.begin() + static_cast<std::ptrdiff_t>(first);
    auto end = begin;
    for (std::size_t i = group.begin; i < group.end; ++i) *end++ = sweep_.sphere_at(group, i);
    std::sort(begin, end);
    return static_cast<std::uint32_t>(first / kBvhWidth) | WideBvh<T>::kLeaf;
  }

  std::span<Member<T>> members_;
  SweepSplitter<T> sweep_;
};

/// Puts subtrees one behind the other, each node before those below it.
template <typename T>
class Splicer {
 public:
  explicit Splicer(Subtree<T>& root) { place(root); }

  void write_to(WideBvh<T>& bvh) {
    bvh.nodes.resize(nodes_);
    bvh.slots.resize(leaves_ * kBvhWidth);
    tbb::parallel_for(std::size_t{0}, places_.size(),
                      [&](std::size_t i) { write(places_[i], bvh); });
  }

 private:
  struct Place {
    Subtree<T>* tree;
    std::uint32_t first_node, first_leaf;
  };

  /// What a node above has to say to mean this subtree.
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
          // 0, the root, is where there is no child.
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
Member<T> member_of(const Scene& scene, std::uint32_t index) {
  const Sphere& sphere = scene.spheres[index];
  Member<T> member(sphere.center, sphere.radius, index);
  if (!scene.shifts.empty()) {
    member.add({sphere.center + scene.shifts[index], sphere.radius, index});
  }
  return member;
}

}  // namespace

template <typename T>
WideBvh<T>::WideBvh(const Scene& scene, std::span<const std::uint32_t> spheres) {
  if (spheres.empty()) return;
  Subtree<T> tree;
  {
    const auto members = std::make_unique_for_overwrite<Member<T>[]>(spheres.size());  // NOLINT
    const auto source = [&](std::size_t i) { return member_of<T>(scene, spheres[i]); };
    tree = Builder<T>({members.get(), spheres.size()}).build(source);
  }
  Splicer<T>(tree).write_to(*this);
}

template struct WideBvh<float>;
template struct WideBvh<double>;

}  // namespace sdlc::render
