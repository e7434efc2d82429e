#include "lang/eval/elementary.hpp"

#include <bit>
#include <cstdint>
#include <limits>

namespace sdlc::lang {
namespace {

/// The unevaluated sum hi + lo, |lo| at most half an ulp of hi: about 106 bits.
/// Dekker, A floating-point technique for extending the available precision, Numer. Math. 18
/// (1971).
struct DoubleDouble {
  double hi = 0, lo = 0;
};

DoubleDouble fast_two_sum(double a, double b) noexcept {
  const double sum = a + b;
  return {sum, b - (sum - a)};
}

DoubleDouble two_sum(double a, double b) noexcept {
  const double sum = a + b;
  const double b_part = sum - a;
  return {sum, (a - (sum - b_part)) + (b - b_part)};
}

/// Precondition: |a| and |b| below 2^995.
DoubleDouble two_product(double a, double b) noexcept {
  const auto split = [](double x) -> DoubleDouble {
    const double scaled = 134217729.0 * x;  // 2^27 + 1
    const double hi = scaled - (scaled - x);
    return {hi, x - hi};
  };
  const DoubleDouble x = split(a), y = split(b);
  const double product = a * b;
  return {product, ((x.hi * y.hi - product) + x.hi * y.lo + x.lo * y.hi) + x.lo * y.lo};
}

DoubleDouble operator+(DoubleDouble a, DoubleDouble b) noexcept {
  const DoubleDouble high = two_sum(a.hi, b.hi), low = two_sum(a.lo, b.lo);
  const DoubleDouble sum = fast_two_sum(high.hi, high.lo + low.hi);
  return fast_two_sum(sum.hi, sum.lo + low.lo);
}

DoubleDouble operator*(DoubleDouble a, DoubleDouble b) noexcept {
  const DoubleDouble product = two_product(a.hi, b.hi);
  return fast_two_sum(product.hi, product.lo + (a.hi * b.lo + a.lo * b.hi));
}

DoubleDouble operator/(DoubleDouble a, DoubleDouble b) noexcept {
  const auto minus = [](DoubleDouble x, DoubleDouble y) { return x + DoubleDouble{-y.hi, -y.lo}; };
  const double first = a.hi / b.hi;
  const DoubleDouble rest = minus(a, b * DoubleDouble{first, 0});
  const double second = rest.hi / b.hi;
  const DoubleDouble last = minus(rest, b * DoubleDouble{second, 0});
  return fast_two_sum(first, second) + DoubleDouble{last.hi / b.hi, 0};
}

constexpr DoubleDouble kLn2{0x1.62e42fefa39efp-1, 0x1.abc9e3b39803fp-56};

/// 2^exponent for -1022 <= exponent <= 1023.
double power_of_two(int exponent) noexcept {
  return std::bit_cast<double>(static_cast<std::uint64_t>(exponent + 1023) << 52);
}

/// ln x as 2 artanh((m - 1) / (m + 1)) + e ln 2, where x = m 2^e and m is within a factor of sqrt 2
/// of 1.
DoubleDouble logarithm(double x) noexcept {
  int exponent = 0;
  if (x < std::numeric_limits<double>::min()) {
    x *= 0x1p54;
    exponent = -54;
  }
  const auto bits = std::bit_cast<std::uint64_t>(x);
  exponent += static_cast<int>(bits >> 52) - 1023;
  double m = std::bit_cast<double>((bits & 0x000FFFFFFFFFFFFF) | 0x3FF0000000000000);
  if (m > 1.4142135623730951) {
    m *= 0.5;
    ++exponent;
  }

  const DoubleDouble s = DoubleDouble{m - 1, 0} / two_sum(m, 1);
  const DoubleDouble square = s * s;
  DoubleDouble sum;
  for (int k = 23; k >= 0; --k) {  // the next term is below 2^-118 of the sum
    sum = sum * square + DoubleDouble{1, 0} / DoubleDouble{2.0 * k + 1, 0};
  }
  return s * sum * DoubleDouble{2, 0} + kLn2 * DoubleDouble{static_cast<double>(exponent), 0};
}

/// e^z by its Taylor series around the nearest multiple of ln 2.
double exponential(DoubleDouble z) noexcept {
  if (z.hi > 709.79) return std::numeric_limits<double>::infinity();
  if (z.hi < -745.14) return 0;
  const int k = static_cast<int>(z.hi / kLn2.hi + (z.hi < 0 ? -0.5 : 0.5));
  const DoubleDouble r = z + kLn2 * DoubleDouble{-static_cast<double>(k), 0};
  DoubleDouble sum{1, 0};
  for (int n = 27; n >= 1; --n) {  // the next term is below 2^-130
    sum = sum * r / DoubleDouble{static_cast<double>(n), 0} + DoubleDouble{1, 0};
  }
  // In two steps: 2^k itself may be out of range where the result is not.
  const int half = k / 2;
  return sum.hi * power_of_two(half) * power_of_two(k - half);
}

}  // namespace

double power(double x, double y) noexcept {
  // Beyond this the result is 1 to the last bit, 0 or infinite, and the products below could
  // overflow.
  constexpr double kLargest = 0x1p900;
  if (x == 1 || y == 0) return 1;
  if (y > kLargest || y < -kLargest) {
    return (y > 0) == (x > 1) ? std::numeric_limits<double>::infinity() : 0;
  }
  return exponential(logarithm(x) * DoubleDouble{y, 0});
}

}  // namespace sdlc::lang
