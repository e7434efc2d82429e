#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "render/hierarchy/wide_bvh.hpp"
#include "render/math/vec3.hpp"

namespace sdlc::render {

/// One number per axis, plus an unused one that fills the registers. Uses 16-byte registers, which
/// every machine has: compilers split larger vectors through memory.
template <typename T>
class Axes {
 public:
  static constexpr std::size_t kLanes = 16 / sizeof(T), kParts = 4 / kLanes;
  using Part __attribute__((vector_size(16))) = T;

  Axes() = default;  // not initialised
  Axes(T x, T y, T z, T last) noexcept {
    if constexpr (kParts == 1) {
      parts[0] = Part{x, y, z, last};
    } else {
      parts[0] = Part{x, y};
      parts[1] = Part{z, last};
    }
  }

  T operator[](std::size_t i) const noexcept { return parts[i / kLanes][i % kLanes]; }

  Part parts[kParts];  // NOLINT: registers
};

/// Applies `operation` to each pair of registers.
template <typename T, typename Operation>
Axes<T> combined(const Axes<T>& a, const Axes<T>& b, const Operation& operation) noexcept {
  Axes<T> result;
  for (std::size_t i = 0; i < Axes<T>::kParts; ++i) {
    operation(result.parts[i], a.parts[i], b.parts[i]);
  }
  return result;
}
template <typename T>
Axes<T> lanewise_min(const Axes<T>& a, const Axes<T>& b) noexcept {
  return combined(a, b, [](auto& to, const auto& x, const auto& y) { to = x < y ? x : y; });
}
template <typename T>
Axes<T> operator+(const Axes<T>& a, const Axes<T>& b) noexcept {
  return combined(a, b, [](auto& to, const auto& x, const auto& y) { to = x + y; });
}
template <typename T>
Axes<T> operator-(const Axes<T>& a, const Axes<T>& b) noexcept {
  return combined(a, b, [](auto& to, const auto& x, const auto& y) { to = x - y; });
}
template <typename T>
Axes<T> operator*(const Axes<T>& a, const Axes<T>& b) noexcept {
  return combined(a, b, [](auto& to, const auto& x, const auto& y) { to = x * y; });
}

/// An axis-aligned box for the builder, initially empty. The upper bounds are negated, so that
/// every side grows by a minimum.
template <typename T>
struct BuildBox {
  static constexpr T kInfinity = std::numeric_limits<T>::infinity();

  Axes<T> lows{kInfinity, kInfinity, kInfinity, kInfinity};
  Axes<T> minus_highs{kInfinity, kInfinity, kInfinity, kInfinity};

  T low(std::size_t axis) const noexcept { return lows[axis]; }
  T high(std::size_t axis) const noexcept { return -minus_highs[axis]; }

  void add(const BuildBox& other) noexcept {
    lows = lanewise_min(lows, other.lows);
    minus_highs = lanewise_min(minus_highs, other.minus_highs);
  }
  T half_area() const noexcept {
    const Axes<T> minus_size = lows + minus_highs;  // the signs cancel in products
    return minus_size[0] * minus_size[1] + minus_size[1] * minus_size[2] +
           minus_size[2] * minus_size[0];
  }
};

/// A sphere to be put into a leaf, with its bounding box over the whole shutter: two registers.
template <typename T>
class alignas(8 * sizeof(T)) Primitive {
 public:
  Primitive() = default;  // not initialised, because there are many
  /// A static sphere.
  Primitive(Vec3 center, double radius, std::uint32_t sphere) noexcept {
    const auto side = [](double v) { return static_cast<T>(v); };
    // Stored in both, so that their difference is 0: some processors are slow with subnormal
    // numbers.
    const T last = std::bit_cast<T>(Bits{sphere});
    lows_ =
        Axes<T>{side(center.x - radius), side(center.y - radius), side(center.z - radius), last};
    minus_highs_ =
        Axes<T>{side(-center.x - radius), side(-center.y - radius), side(-center.z - radius), last};
  }
  /// Adds the bounds of the same sphere at another time.
  void add(const Primitive& other) noexcept {
    BuildBox<T> both = box();
    both.add(other.box());
    lows_ = both.lows;
    minus_highs_ = both.minus_highs;
  }

  BuildBox<T> box() const noexcept { return {.lows = lows_, .minus_highs = minus_highs_}; }
  std::uint32_t sphere() const noexcept {
    return static_cast<std::uint32_t>(std::bit_cast<Bits>(T{lows_[3]}));
  }
  /// Twice the centroid, as a box; the unused lane is 0.
  BuildBox<T> centroids() const noexcept {
    return {.lows = lows_ - minus_highs_, .minus_highs = minus_highs_ - lows_};
  }
  T centroid(std::size_t axis) const noexcept { return lows_[axis] - minus_highs_[axis]; }

 private:
  using Bits = std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>;

  Axes<T> lows_, minus_highs_;  // the unused lane holds the sphere
};

/// The primitives [begin, end) and their bounding box.
template <typename T>
struct Range {
  static constexpr std::size_t kNotSorted = ~std::size_t{0};

  std::size_t begin = 0, end = 0;
  BuildBox<T> box;
  /// The base of the indices in SweepSplitter's orders, if this range is sorted.
  std::size_t sorted_from = kNotSorted;

  std::size_t count() const noexcept { return end - begin; }
  bool is_leaf() const noexcept { return count() <= kBvhWidth; }
  bool is_sorted() const noexcept { return sorted_from != kNotSorted; }
};

/// The ranges below a node.
template <typename T>
struct NodeRanges {
  std::array<Range<T>, kBvhWidth> of;
  std::size_t count = 0;
};

/// The cost of testing the spheres of a range: one operation per sixteen.
template <typename T>
T leaf_cost(std::size_t count) noexcept {
  return static_cast<T>(static_cast<std::uint32_t>((count + kBvhWidth - 1) / kBvhWidth));
}

}  // namespace sdlc::render
