#pragma once

#include <cstdint>
#include <string_view>

#include "render/math/vec3.hpp"

/// The random numbers of the language. They are pure functions of their arguments.
namespace sdlc::lang {

/// Hashes the arguments of `random(a, ...)`, which are added one by one. The type of an
/// argument is part of the hash, so 1 and `1deg` differ; -0 and 0 are equal.
class RandomHash {
 public:
  RandomHash& add_number(double number) noexcept;
  RandomHash& add_bool(bool flag) noexcept;
  RandomHash& add_string(std::string_view text) noexcept;
  RandomHash& add_vec3(render::Vec3 v) noexcept;
  RandomHash& add_angle(double degrees) noexcept;

  /// The random number: uniform in [0, 1), a multiple of 2^-53.
  double uniform() const noexcept { return static_cast<double>(hash_ >> 11) * 0x1p-53; }

 private:
  void add_word(std::uint64_t word) noexcept;
  void add_bits(double number) noexcept;

  std::uint64_t hash_ = 0;
};

/// Value noise between -1 and 1, smooth in `p`. A point with integer coordinates has the value
/// 2 random("noise", x, y, z) - 1. The values of the eight such points around `p` are interpolated
/// along x, then y, then z, with the weight t^3 (6 t^2 - 15 t + 10) of Perlin,
/// Improving noise, SIGGRAPH 2002.
double noise(render::Vec3 p) noexcept;

}  // namespace sdlc::lang
