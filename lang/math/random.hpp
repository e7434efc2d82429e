#pragma once

#include <cstdint>
#include <string_view>

#include "render/math/vec3.hpp"

/// Random numbers of the language: pure functions of their arguments.
namespace sdlc::lang {

/// A hash of the arguments of `random(a, ...)`, added one by one (ruling 26). Arguments of
/// different types give different hashes; -0 is 0.
class RandomHash {
 public:
  RandomHash& add_number(double number) noexcept;
  RandomHash& add_bool(bool flag) noexcept;
  RandomHash& add_string(std::string_view text) noexcept;
  RandomHash& add_vec3(render::Vec3 v) noexcept;
  RandomHash& add_angle(double degrees) noexcept;

  /// Uniform in [0, 1), never 1: a multiple of 2^-53.
  double uniform() const noexcept { return static_cast<double>(hash_ >> 11) * 0x1p-53; }

 private:
  void add_word(std::uint64_t word) noexcept;
  void add_bits(double number) noexcept;

  std::uint64_t hash_ = 0;
};

/// Value noise between -1 and 1, smooth in `p`: the eight corners of the unit cube around `p`,
/// each of value 2 random("noise", x, y, z) - 1, mixed along x, then y, then z (ruling 27).
/// Perlin, Improving noise, SIGGRAPH 2002, for the weight t^3 (6 t^2 - 15 t + 10).
double noise(render::Vec3 p) noexcept;

}  // namespace sdlc::lang
