#pragma once

#include <array>

#include "lang/math/double_double.hpp"

/// Power series in double-double. Private to this folder.
namespace sdlc::lang {

/// 1, 1/3, 1/5, ...
inline constexpr auto kOddReciprocals = [] {
  std::array<DoubleDouble, 24> table;
  for (int k = 0; k < 24; ++k) table[k] = DoubleDouble{1, 0} / DoubleDouble{2.0 * k + 1, 0};
  return table;
}();

/// 1, 1/1!, 1/2!, ...
inline constexpr auto kFactorialReciprocals = [] {
  std::array<DoubleDouble, 30> table{DoubleDouble{1, 0}};
  for (int n = 1; n < 30; ++n) {
    table[n] = table[n - 1] / DoubleDouble{static_cast<double>(n), 0};
  }
  return table;
}();

/// 1 + z/3 + z^2/5 + ..., at most 24 terms: artanh s = s series(s^2), arctan t = t series(-t^2).
constexpr DoubleDouble odd_reciprocal_series(DoubleDouble z, int terms) noexcept {
  DoubleDouble sum;
  for (int k = terms - 1; k >= 0; --k) sum = sum * z + kOddReciprocals[k];
  return sum;
}

/// 1/first! - x^2/(first + 2)! + x^4/(first + 4)! - ..., the powers up to x^28: the cosine of x for
/// `first` 0, and sin x / x for 1. For |x| < 0.8 the next term is below 2^-112.
constexpr DoubleDouble alternating_factorial_series(DoubleDouble x, int first) noexcept {
  const DoubleDouble z = -(x * x);
  DoubleDouble sum;
  for (int n = 28; n >= 0; n -= 2) sum = sum * z + kFactorialReciprocals[n + first];
  return sum;
}

}  // namespace sdlc::lang
