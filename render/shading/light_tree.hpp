#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "render/math/vec3.hpp"

namespace sdlc::render {

/// Marks a leaf of the tree without a light.
inline constexpr std::uint32_t kNoLight = 0xFFFFFFFF;

/// An emissive sphere as the tree sees it.
struct LightSphere {
  Vec3 center;  ///< at shutter opening
  Vec3 shift;   ///< displacement until the shutter closes
  double radius = 0;
  double power = 0;  ///< relative to the others, finite and not negative
};

/// Chooses one of many lights at random, with a probability that grows with the light it may send
/// to a point: a binary tree of bounding spheres, descended with one random number (Conty Estevez,
/// Kulla, "Importance sampling of many lights with adaptive tree splitting", 2018, without
/// splitting). All leaves are on one level, so wide kernels need no leaf test; unused leaves, on
/// the right of every node, are empty.
///
/// Nodes are numbered as in a heap: the root is 1, the children of i are 2i and 2i + 1, and leaf j
/// is node 2^levels + j, so the bits of j are the path to it.
class LightTree {
 public:
  LightTree() = default;
  /// O(n log n) time. Coordinates have to be moderate, as after rebase_to_camera().
  explicit LightTree(const std::vector<LightSphere>& lights);

  /// The first random number is used for this many levels, the second one below: a float has no
  /// more digits.
  static constexpr int kLevelsPerNumber = 12;

  /// The bounding sphere of all lights below a node, over the whole shutter, and their total power.
  struct Node {
    Vec3 center;
    double radius = 0;
    double power = 0;
  };
  const std::vector<Node>& nodes() const noexcept { return nodes_; }  ///< index 0 is unused
  int levels() const noexcept { return levels_; }
  /// The index of the light of each leaf; kNoLight if it is empty.
  const std::vector<std::uint32_t>& lights_of_leaves() const noexcept { return lights_of_leaves_; }

 private:
  void build(const std::vector<LightSphere>& lights, std::uint32_t* first, std::uint32_t* last,
             std::size_t node, int levels_below);

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> lights_of_leaves_;
  int levels_ = 0;
};

}  // namespace sdlc::render
