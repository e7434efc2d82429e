#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "render/math/vec3.hpp"
#include "render/sampler/sampler.hpp"

namespace sdlc::render {

/// The place of a light among the leaves of a tree.
inline constexpr std::uint32_t kNoLight = 0xFFFFFFFF;

/// A sphere that shines, as the tree sees it.
struct LightBall {
  Vec3 center;  ///< at the opening of the shutter
  Vec3 shift;   ///< up to its closing
  double radius = 0;
  double power = 0;  ///< relative to that of others, finite and not negative
};

/// Chooses one of many lights at random, the sooner the more of its light may arrive at a place: a
/// binary tree of balls around lights, gone down with one random number (Conty Estevez, Kulla,
/// "Importance sampling of many lights with adaptive tree splitting", 2018, without splitting). All
/// leaves are on one level, so that wide kernels need no test for them, and those to spare, on the
/// right of every node, hold nothing.
///
/// Nodes are numbered as in a heap: the root is 1, the children of i are 2i and 2i + 1, and leaf j
/// is node 2^levels + j: its bits are the way to it.
class LightTree {
 public:
  LightTree() = default;
  /// O(n log n) time. `balls` in a frame of moderate numbers, as of rebase_to_camera().
  explicit LightTree(const std::vector<LightBall>& balls);

  struct Choice {
    std::uint32_t leaf = 0;
    double probability = 0;  ///< 0: no light
  };
  /// One of the lights for the place `x`, which light reaches from the side of the unit vector
  /// `normal` alone.
  Choice choose(Vec3 x, Vec3 normal, UniformPair random) const noexcept;
  /// Choice::probability of a leaf.
  double probability(std::uint32_t leaf, Vec3 x, Vec3 normal) const noexcept;

  /// The first random number is asked on so many levels, and the second below: a float has no
  /// digits for more.
  static constexpr int kLevelsANumber = 12;

  /// A ball around all lights below a node, over the whole shutter, and what they shine together.
  struct Node {
    Vec3 center;
    double radius = 0;
    double power = 0;
  };
  const std::vector<Node>& nodes() const noexcept { return nodes_; }  ///< the first is none
  int levels() const noexcept { return levels_; }
  /// Which of the balls is a leaf; kNoLight: none.
  const std::vector<std::uint32_t>& balls_of_leaves() const noexcept { return balls_of_leaves_; }

 private:
  void build(const std::vector<LightBall>& balls, std::uint32_t* first, std::uint32_t* last,
             std::size_t node, int levels_below);
  double importance(std::size_t node, Vec3 x, Vec3 normal) const noexcept;

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> balls_of_leaves_;
  int levels_ = 0;
};

}  // namespace sdlc::render
