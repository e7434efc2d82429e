#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

#include "render/math/vec3.hpp"

namespace sdlc::render {

/// An axis-aligned box, initially empty.
struct Box {
  std::array<double, 3> low{kInfinity, kInfinity, kInfinity};
  std::array<double, 3> high{-kInfinity, -kInfinity, -kInfinity};

  static constexpr double kInfinity = std::numeric_limits<double>::infinity();

  void add(const Box& other) noexcept {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], other.low[axis]);
      high[axis] = std::max(high[axis], other.high[axis]);
    }
  }
  void add(Vec3 center, double radius) noexcept {
    const std::array<double, 3> c{center.x, center.y, center.z};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], c[axis] - radius);
      high[axis] = std::max(high[axis], c[axis] + radius);
    }
  }
  double half_area() const noexcept {
    const double x = high[0] - low[0], y = high[1] - low[1], z = high[2] - low[2];
    return x * y + y * z + z * x;
  }
};

}  // namespace sdlc::render
