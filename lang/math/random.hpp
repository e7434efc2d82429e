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

  /// With the arguments (name, i) added: the i-th number of a function that needs several.
  double uniform_of(std::string_view name, int i) const noexcept {
    return RandomHash(*this).add_string(name).add_number(i).uniform();
  }

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

/// The sum of noise(2^k p + k s) / 2^k for k = 0 … octaves - 1, divided by the sum of the 1 / 2^k,
/// so that it stays between -1 and 1. The shift s keeps the lattices of the octaves apart: without
/// it, (0, 0, 0) would be a corner of all of them. Precondition: 2^octaves p is finite.
double noise(render::Vec3 p, int octaves) noexcept;

// The numbers u_i below are random(a, …, NAME, i), with the name of the function in the language.

/// `random_in_disc`: uniform in the disc of radius 1 about the origin, z = 0: radius sqrt(u_0),
/// angle u_1 turns.
render::Vec3 random_in_disc(const RandomHash& arguments) noexcept;
/// `random_on_sphere`: uniform on the sphere of radius 1: z = 2 u_0 - 1, angle u_1 turns
/// (Archimedes).
render::Vec3 random_on_sphere(const RandomHash& arguments) noexcept;
/// `random_in_sphere`: uniform in it: a point on it as above, times the cube root of u_2.
render::Vec3 random_in_sphere(const RandomHash& arguments) noexcept;
/// `random_normal`: mean 0 and standard deviation 1: sqrt(-2 log(1 - u_0)) cos(u_1 turns) (Box and
/// Muller, A Note on the Generation of Random Normal Deviates, 1958).
double random_normal(const RandomHash& arguments) noexcept;

}  // namespace sdlc::lang
