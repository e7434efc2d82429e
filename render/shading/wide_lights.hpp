#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "render/math/vector_allocator.hpp"
#include "render/shading/lights.hpp"

namespace sdlc::render {

/// The lights of a scene for the wide kernel, in numbers of type T. Tables are padded to whole
/// vectors.
template <typename T>
struct WideLights {
  using Table = std::vector<T, VectorAllocator<T>>;
  using IndexTable = std::vector<std::uint32_t, VectorAllocator<std::uint32_t>>;
  using TableTriple = std::array<Table, 3>;

  WideLights() = default;
  /// `slots` is the number of slots in the scene; the first ones hold its spheres in this order,
  /// given by index.
  WideLights(const Lights& lights, std::span<const std::uint32_t> order, std::size_t slots);

  // By node of the LightTree.
  TableTriple node_center;
  Table node_radius;
  Table node_power;

  // By leaf of the tree: the lights, as in Light.
  TableTriple center;
  TableTriple shift;
  Table radius;
  TableTriple radiance;
  IndexTable slot;

  IndexTable leaf_of_slot;  ///< kNoLight: not a light

  std::uint32_t nodes = 0;   ///< of the tree; 0 without lights
  std::uint32_t leaves = 0;  ///< number of leaves, and the node index of the first one
  int levels = 0;

  std::size_t memory_bytes() const noexcept;
};

extern template struct WideLights<float>;
extern template struct WideLights<double>;

}  // namespace sdlc::render
