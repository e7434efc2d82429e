#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "render/scene/scene.hpp"

namespace sdlc::render {

/// Children of a node, and spheres of a leaf: one register of floats with AVX-512.
inline constexpr std::size_t kBvhWidth = 16;

/// A bounding volume hierarchy for the wide kernel: one ray against the boxes of all children, or
/// all spheres of a leaf, at once. Boxes cover the whole shutter.
///
/// The spheres of leaf i are those of the slots from 16 i on, in the scene's order; slots that a
/// leaf does not fill come behind and hold kNoSphere.
template <typename T>
struct WideBvh {
  static constexpr std::uint32_t kNoSphere = 0xFFFFFFFF;
  static constexpr std::uint32_t kLeaf = 0x80000000;

  struct alignas(64) Node {
    /// [axis][low, high][child]; low above high where there is no child.
    std::array<std::array<std::array<T, kBvhWidth>, 2>, 3> bounds;
    /// The index of a node, or that of a leaf with the bit kLeaf.
    std::array<std::uint32_t, kBvhWidth> children;
  };

  WideBvh() = default;
  /// Over the spheres `members` of a rebased scene: their extent is at most 2.
  WideBvh(const Scene& scene, std::span<const std::uint32_t> members);

  std::vector<Node> nodes;           ///< the root first; empty without spheres
  std::vector<std::uint32_t> slots;  ///< the sphere in each
  /// Of nodes that wait while one ray is followed.
  static constexpr std::size_t kMostWaiting = 1024;
};

extern template struct WideBvh<float>;
extern template struct WideBvh<double>;

}  // namespace sdlc::render
