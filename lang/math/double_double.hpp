#pragma once

#include <cmath>

namespace sdlc::lang {

/// A number of about 106 bits, as the unevaluated sum hi + lo with |lo| at most half an ulp of hi:
/// hi is the number rounded to a double. Private to this folder.
/// Dekker, A floating-point technique for extending the available precision, Numer. Math. 18
/// (1971).
struct DoubleDouble {
  double hi = 0, lo = 0;
};

/// a + b (Fast2Sum): exact if |a| >= |b|.
constexpr DoubleDouble fast_two_sum(double a, double b) noexcept {
  const double sum = a + b;
  return {sum, b - (sum - a)};
}

/// a + b (Knuth's TwoSum): exact for all a and b, unless it overflows.
constexpr DoubleDouble two_sum(double a, double b) noexcept {
  const double sum = a + b;
  const double b_part = sum - a;
  return {sum, (a - (sum - b_part)) + (b - b_part)};
}

/// a * b (Dekker's product, with Veltkamp's split of the factors): exact unless the low half is
/// subnormal. Precondition: |a| and |b| below 2^995.
constexpr DoubleDouble two_product(double a, double b) noexcept {
  const auto split = [](double x) -> DoubleDouble {
    const double scaled = 134217729.0 * x;  // 2^27 + 1
    const double hi = scaled - (scaled - x);
    return {hi, x - hi};
  };
  const DoubleDouble x = split(a), y = split(b);
  const double product = a * b;
  return {product, ((x.hi * y.hi - product) + x.hi * y.lo + x.lo * y.hi) + x.lo * y.lo};
}

constexpr DoubleDouble operator-(DoubleDouble a) noexcept { return {-a.hi, -a.lo}; }

constexpr DoubleDouble operator+(DoubleDouble a, DoubleDouble b) noexcept {
  const DoubleDouble high = two_sum(a.hi, b.hi), low = two_sum(a.lo, b.lo);
  const DoubleDouble sum = fast_two_sum(high.hi, high.lo + low.hi);
  return fast_two_sum(sum.hi, sum.lo + low.lo);
}

constexpr DoubleDouble operator-(DoubleDouble a, DoubleDouble b) noexcept { return a + -b; }

constexpr DoubleDouble operator*(DoubleDouble a, DoubleDouble b) noexcept {
  const DoubleDouble product = two_product(a.hi, b.hi);
  return fast_two_sum(product.hi, product.lo + (a.hi * b.lo + a.lo * b.hi));
}

constexpr DoubleDouble operator/(DoubleDouble a, DoubleDouble b) noexcept {
  const double first = a.hi / b.hi;
  const DoubleDouble rest = a - b * DoubleDouble{first, 0};
  const double second = rest.hi / b.hi;
  const DoubleDouble last = rest - b * DoubleDouble{second, 0};
  return fast_two_sum(first, second) + DoubleDouble{last.hi / b.hi, 0};
}

/// Precondition: a >= 0.
inline DoubleDouble sqrt(DoubleDouble a) noexcept {
  if (a.hi == 0) return {};
  const double root = std::sqrt(a.hi);
  return fast_two_sum(root, (a - two_product(root, root)).hi / (2 * root));  // one Newton step
}

/// value * 2^exponent as a double, rounded only once, even if the result is subnormal.
/// Precondition: 2^-100 < |value| < 2^100.
inline double scaled(DoubleDouble value, int exponent) noexcept {
  if (exponent < -1200) return 0;
  if (std::fabs(value.hi) >= std::ldexp(1.0, -1022 - exponent))
    return std::ldexp(value.hi, exponent);
  // The result is subnormal. The ulp of `grid` is 2^-1074 once scaled, as that of all subnormals,
  // so adding and subtracting `grid` rounds the value to a multiple of it.
  const double grid = std::copysign(std::ldexp(1.0, 52 - 1074 - exponent), value.hi);
  return std::ldexp((DoubleDouble{grid, 0} + value).hi - grid, exponent);
}

}  // namespace sdlc::lang
