#pragma once

#include <cmath>
#include <cstdint>

namespace sdlc::lang {

/// A sequence of arguments for testing functions, the same on every machine: integers and exact
/// operations only (the standard's distributions differ between libraries).
class Arguments {
 public:
  /// In [low, high].
  double between(double low, double high) noexcept { return low + (high - low) * uniform(); }

  /// With magnitudes of 2^low ... 2^(high + 1), all binary orders equally likely.
  double of_any_size(int low, int high) noexcept {
    const int exponent = low + static_cast<int>((high - low + 1) * uniform());
    return std::ldexp(1 + uniform(), exponent);
  }
  double of_any_size_and_sign(int low, int high) noexcept {
    const double magnitude = of_any_size(low, high);
    return uniform() < 0.5 ? -magnitude : magnitude;
  }

  /// Near `value`, at all binary orders of distance down to 2^-53 of it.
  double close_to(double value) noexcept { return value * (1 + of_any_size_and_sign(-53, -4)); }

 private:
  /// Knuth, The Art of Computer Programming, volume 2, 3.3.4, table 1, line 26 (MMIX).
  double uniform() noexcept {
    state_ = state_ * 6364136223846793005u + 1442695040888963407u;
    return static_cast<double>(state_ >> 11) * 0x1p-53;
  }

  std::uint64_t state_ = 1;
};

}  // namespace sdlc::lang
