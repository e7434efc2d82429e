#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "render/scene/scene.hpp"
#include "render/wide/vector_allocator.hpp"

namespace sdlc::render {

/// Where instances are, as the wide kernel reads it in double. A sphere is named by its slot and
/// the row of its instance; row 0 is the world, which puts its spheres where they are.
struct InstanceTable {
  /// A row's numbers, two cache lines.
  static constexpr std::size_t kRowSize = 16;
  enum Column : std::size_t {
    kAxes = 0,       ///< the prototype's three axes in the world, of unit length
    kTranslate = 9,  ///< where its origin is
    kScale = 12,     ///< above 0
    kInverseScale = 13,
    kRoot = 14,  ///< the node where the hierarchy of its spheres begins
  };

  std::vector<double, VectorAllocator<double>> rows;
  /// Displacements up to the closing of the shutter, by row; empty where no instance moves.
  std::array<std::vector<double, VectorAllocator<double>>, 3> shift;
  /// The row of the instance in whose place the hierarchy of instances has a ball around all of it,
  /// by slot, from that of the first ball on.
  std::vector<std::uint32_t> row_of_ball;
  std::uint32_t first_ball = 0;      ///< slot
  std::uint32_t root = 0;            ///< node
  std::uint32_t world_root = kNone;  ///< node; kNone where all spheres are instances'
  std::uint32_t camera_row = 0;      ///< of the sphere on which the camera stands

  static constexpr std::uint32_t kNone = 0xFFFFFFFF;

  bool empty() const noexcept { return rows.empty(); }
  std::size_t count() const noexcept { return rows.size() / kRowSize; }
  std::size_t memory_bytes() const noexcept;

  void add_row(const Placement& placement, std::uint32_t root_of_prototype);
};

/// A ball around each instance of a rebased scene, in their order, that no ray misses which hits a
/// sphere in it by more than rounding.
Prototype balls_of_instances(const Scene& scene);

}  // namespace sdlc::render
