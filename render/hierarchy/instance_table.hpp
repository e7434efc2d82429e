#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "render/math/vector_allocator.hpp"
#include "render/scene/scene.hpp"

namespace sdlc::render {

/// The instances of a scene in double, for the wide kernel. A sphere is identified by its slot and
/// the row of its instance; row 0 is the world, with the identity transformation.
struct InstanceTable {
  /// Numbers per row; two cache lines.
  static constexpr std::size_t kRowSize = 16;
  enum Column : std::size_t {
    kAxes = 0,       ///< the prototype's axes in world coordinates, of unit length
    kTranslate = 9,  ///< the position of its origin
    kScale = 12,     ///< above 0
    kInverseScale = 13,
    kRoot = 14,  ///< root node of its BVH
  };

  std::vector<double, VectorAllocator<double>> rows;
  /// Displacements until the shutter closes, by row; empty if no instance moves.
  std::array<std::vector<double, VectorAllocator<double>>, 3> shift;
  /// The row of the instance for each bounding sphere in the BVH of instances, by slot minus
  /// `first_bounds`.
  std::vector<std::uint32_t> row_of_bounds;
  std::uint32_t first_bounds = 0;    ///< slot
  std::uint32_t root = 0;            ///< node
  std::uint32_t world_root = kNone;  ///< node; kNone where all spheres are instances'
  std::uint32_t camera_row = 0;      ///< of the sphere that contains the camera in its surface

  static constexpr std::uint32_t kNone = 0xFFFFFFFF;

  bool empty() const noexcept { return rows.empty(); }
  std::size_t count() const noexcept { return rows.size() / kRowSize; }
  std::size_t memory_bytes() const noexcept;

  void add_row(const Placement& placement, std::uint32_t root_of_prototype);
};

/// Returns the bounding sphere of each instance of a rebased scene, in order. Slightly enlarged, so
/// that every ray that hits a sphere of the instance also hits its bounding sphere, despite
/// rounding.
Prototype instance_bounds(const Scene& scene);

}  // namespace sdlc::render
