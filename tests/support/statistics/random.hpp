#pragma once

#include <random>

#include "render/math/vec3.hpp"

namespace sdlc::test {

/// Numbers and vectors determined by a seed.
class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double between(double a, double b) {
    return std::uniform_real_distribution<double>(a, b)(engine_);
  }
  render::Vec3 in_box(double size) {
    return {between(-size, size), between(-size, size), between(-size, size)};
  }
  render::Vec3 direction() {
    render::Vec3 v = in_box(1);
    while (length_squared(v) > 1 || length_squared(v) < 1e-6) v = in_box(1);
    return unit(v);
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace sdlc::test
