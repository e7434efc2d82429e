#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "render/wide/wide_bvh.hpp"

namespace sdlc::render {

/// An axis-aligned box as the builder reads it, at first around nothing: the low sides and then the
/// high ones with their signs changed, so that every side grows by a minimum, several of them in
/// one instruction.
template <typename T>
struct BuildBox {
  static constexpr T kInfinity = std::numeric_limits<T>::infinity();

  std::array<T, 6> sides{kInfinity, kInfinity, kInfinity, kInfinity, kInfinity, kInfinity};

  T low(std::size_t axis) const noexcept { return sides[axis]; }
  T high(std::size_t axis) const noexcept { return -sides[axis + 3]; }

  void add(const BuildBox& other) noexcept {
    for (std::size_t i = 0; i < 6; ++i) sides[i] = std::min(sides[i], other.sides[i]);
  }
  T half_area() const noexcept {
    const auto size = [&](std::size_t axis) { return -(sides[axis] + sides[axis + 3]); };
    const T x = size(0), y = size(1), z = size(2);
    return x * y + y * z + z * x;
  }
};

/// A sphere to be put into a leaf, and the box around it over the whole shutter.
template <typename T>
struct alignas(8 * sizeof(T)) Member {
  BuildBox<T> box;
  std::uint32_t sphere = 0;
  std::uint32_t unused = 0;  // so that copying one takes whole registers

  /// Twice the middle.
  T middle(std::size_t axis) const noexcept { return box.low(axis) + box.high(axis); }
};

/// The members [begin, end) and the box around them.
template <typename T>
struct Group {
  static constexpr std::size_t kNotSorted = ~std::size_t{0};

  std::size_t begin = 0, end = 0;
  BuildBox<T> box;
  /// Where the places that SweepSplitter's orders hold are counted from, once they hold some.
  std::size_t sorted_from = kNotSorted;

  std::size_t count() const noexcept { return end - begin; }
  bool is_leaf() const noexcept { return count() <= kBvhWidth; }
  bool is_sorted() const noexcept { return sorted_from != kNotSorted; }
};

/// Those below a node.
template <typename T>
struct NodeGroups {
  std::array<Group<T>, kBvhWidth> of;
  std::size_t count = 0;
};

/// What the spheres of a group cost a ray that meets its box: one operation for each sixteen.
template <typename T>
T leaf_cost(std::size_t count) noexcept {
  return static_cast<T>(static_cast<std::uint32_t>((count + kBvhWidth - 1) / kBvhWidth));
}

}  // namespace sdlc::render
