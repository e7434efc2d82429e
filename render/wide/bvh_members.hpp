#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "render/math/vec3.hpp"
#include "render/wide/wide_bvh.hpp"

namespace sdlc::render {

/// One number for each axis, and one more that fills the registers and means nothing. Registers are
/// those of every machine: compilers take larger vectors apart in memory.
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

  Part parts[kParts];  // NOLINT: of registers
};

/// `operation` on the registers of two.
template <typename T, typename Operation>
Axes<T> combined(const Axes<T>& a, const Axes<T>& b, const Operation& operation) noexcept {
  Axes<T> result;
  for (std::size_t i = 0; i < Axes<T>::kParts; ++i) {
    operation(result.parts[i], a.parts[i], b.parts[i]);
  }
  return result;
}
template <typename T>
Axes<T> least(const Axes<T>& a, const Axes<T>& b) noexcept {
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

/// An axis-aligned box as the builder reads it, at first around nothing: the high sides have their
/// signs changed, so that every side grows by a minimum.
template <typename T>
struct BuildBox {
  static constexpr T kInfinity = std::numeric_limits<T>::infinity();

  Axes<T> lows{kInfinity, kInfinity, kInfinity, kInfinity};
  Axes<T> minus_highs{kInfinity, kInfinity, kInfinity, kInfinity};

  T low(std::size_t axis) const noexcept { return lows[axis]; }
  T high(std::size_t axis) const noexcept { return -minus_highs[axis]; }

  void add(const BuildBox& other) noexcept {
    lows = least(lows, other.lows);
    minus_highs = least(minus_highs, other.minus_highs);
  }
  T half_area() const noexcept {
    const Axes<T> minus_size = lows + minus_highs;  // of which products are those of the size
    return minus_size[0] * minus_size[1] + minus_size[1] * minus_size[2] +
           minus_size[2] * minus_size[0];
  }
};

/// A sphere to be put into a leaf, and the box around it over the whole shutter: two registers.
template <typename T>
class alignas(8 * sizeof(T)) Member {
 public:
  Member() = default;  // not initialised, for there are many
  /// A sphere that stands still.
  Member(Vec3 center, double radius, std::uint32_t sphere) noexcept {
    const auto side = [](double v) { return static_cast<T>(v); };
    // In both, so that their difference is 0: some processors are slow with numbers so tiny.
    const T last = std::bit_cast<T>(Bits{sphere});
    lows_ =
        Axes<T>{side(center.x - radius), side(center.y - radius), side(center.z - radius), last};
    minus_highs_ =
        Axes<T>{side(-center.x - radius), side(-center.y - radius), side(-center.z - radius), last};
  }
  /// The same sphere elsewhere.
  void add(const Member& other) noexcept {
    BuildBox<T> both = box();
    both.add(other.box());
    lows_ = both.lows;
    minus_highs_ = both.minus_highs;
  }

  BuildBox<T> box() const noexcept { return {.lows = lows_, .minus_highs = minus_highs_}; }
  std::uint32_t sphere() const noexcept {
    return static_cast<std::uint32_t>(std::bit_cast<Bits>(T{lows_[3]}));
  }
  /// Twice the middle, as a box; what means nothing is 0.
  BuildBox<T> middles() const noexcept {
    return {.lows = lows_ - minus_highs_, .minus_highs = minus_highs_ - lows_};
  }
  T middle(std::size_t axis) const noexcept { return lows_[axis] - minus_highs_[axis]; }

 private:
  using Bits = std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>;

  Axes<T> lows_, minus_highs_;  // with the sphere where nothing has a meaning
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
