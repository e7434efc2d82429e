#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "render/scene/scene.hpp"

namespace sdlc::render {

/// Children per node, and spheres per leaf: one register of floats with AVX-512.
inline constexpr std::size_t kBvhWidth = 16;

/// The BVH of the wide kernel: one ray is tested with the boxes of all children, or with all
/// spheres of a leaf, at the same time. Boxes cover the whole shutter interval.
///
/// The spheres of leaf i are in the slots from 16 i on, in scene order; unused slots of a leaf are
/// at its end and hold kNoSphere.
template <typename T>
struct WideBvh {
  static constexpr std::uint32_t kNoSphere = 0xFFFFFFFF;
  static constexpr std::uint32_t kLeaf = 0x80000000;

  struct alignas(64) Node {
    /// [axis][low, high][child]; low is above high for missing children.
    std::array<std::array<std::array<T, kBvhWidth>, 2>, 3> bounds;
    /// The index of a node, or of a leaf with the bit kLeaf.
    std::array<std::uint32_t, kBvhWidth> children;
  };

  WideBvh() = default;
  /// Over the spheres `primitives` of a rebased scene, whose extent is at most 2.
  WideBvh(const Scene& scene, std::span<const std::uint32_t> primitives);

  std::vector<Node> nodes;           ///< root first; empty without spheres
  std::vector<std::uint32_t> slots;  ///< the sphere in each slot
  /// The capacity of the traversal stack.
  static constexpr std::size_t kMaxWaiting = 1024;
};

extern template struct WideBvh<float>;
extern template struct WideBvh<double>;

}  // namespace sdlc::render
