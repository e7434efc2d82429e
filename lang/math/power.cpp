#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "lang/math/double_double.hpp"
#include "lang/math/elementary.hpp"
#include "lang/math/series.hpp"

namespace sdlc::lang {
namespace {

constexpr DoubleDouble kLn2{0x1.62e42fefa39efp-1, 0x1.abc9e3b39803fp-56};

/// ln x as 2 artanh((m - 1) / (m + 1)) + e ln 2, where x = m 2^e and m is within a factor of sqrt 2
/// of 1. Precondition: x > 0.
DoubleDouble logarithm(double x) noexcept {
  int exponent = 0;
  if (x < std::numeric_limits<double>::min()) {
    x *= 0x1p54;
    exponent = -54;
  }
  const auto bits = std::bit_cast<std::uint64_t>(x);
  exponent += static_cast<int>(bits >> 52) - 1023;
  auto m = std::bit_cast<double>((bits & 0x000FFFFFFFFFFFFF) | 0x3FF0000000000000);
  if (m > 1.4142135623730951) {
    m *= 0.5;
    ++exponent;
  }

  const DoubleDouble s = DoubleDouble{m - 1, 0} / two_sum(m, 1);
  const DoubleDouble artanh = s * odd_reciprocal_series(s * s, 24);  // the next term: below 2^-118
  return artanh * DoubleDouble{2, 0} + kLn2 * DoubleDouble{static_cast<double>(exponent), 0};
}

/// factor * 2^exponent
struct Exponential {
  DoubleDouble factor;
  int exponent = 0;
};

/// e^z by its Taylor series around the nearest multiple of ln 2. An exponent of ±2000 means
/// a result out of the range of doubles.
Exponential exponential(DoubleDouble z) noexcept {
  if (z.hi > 709.79) return {DoubleDouble{1, 0}, 2000};
  if (z.hi < -745.14) return {DoubleDouble{1, 0}, -2000};
  const int k = static_cast<int>(z.hi / kLn2.hi + (z.hi < 0 ? -0.5 : 0.5));
  const DoubleDouble r = z + kLn2 * DoubleDouble{-static_cast<double>(k), 0};
  DoubleDouble sum;
  for (int n = 27; n >= 0; --n) sum = sum * r + kFactorialReciprocals[n];  // next: below 2^-130
  return {sum, k};
}

/// Beyond 2^53 every double is even.
bool is_odd(double y) noexcept {
  return std::fabs(y) < 0x1p53 && static_cast<std::int64_t>(y) % 2 != 0;
}

}  // namespace

double exp(double x) noexcept {
  const Exponential result = exponential(DoubleDouble{x, 0});
  return scaled(result.factor, result.exponent);
}

std::optional<double> log(double x) noexcept {
  if (x <= 0) return std::nullopt;
  return logarithm(x).hi;
}

double power(double x, double y) noexcept {
  // For larger |y| the result is 1, 0 or infinite to the last bit, and the products below could
  // overflow.
  constexpr double kLargest = 0x1p900;
  if (x == 1 || y == 0) return 1;
  if (y > kLargest || y < -kLargest) {
    return (y > 0) == (x > 1) ? std::numeric_limits<double>::infinity() : 0;
  }
  const Exponential result = exponential(logarithm(x) * DoubleDouble{y, 0});
  return std::ldexp(result.factor.hi, result.exponent);
}

std::optional<double> raise(double x, double y) noexcept {
  const bool is_whole = y == std::floor(y);
  if (x == 0 && y < 0) return std::nullopt;
  if (x < 0 && !is_whole) return std::nullopt;
  if (y == 1) return x;
  if (y == 2) return x * x;
  if (y == 3) return x * x * x;
  if (y == -1) return 1 / x;
  if (x == 0) return y == 0 ? 1 : 0;
  const double magnitude = power(std::fabs(x), y);
  return x < 0 && is_odd(y) ? -magnitude : magnitude;
}

}  // namespace sdlc::lang
