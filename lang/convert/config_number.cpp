#include "lang/convert/config_number.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "lang/object/object.hpp"

namespace sdlc::lang {
namespace {

/// Finds the number with the shortest spelling that gives the component.
class ShortestNumber {
 public:
  explicit ShortestNumber(double component) : component_(component) {}

  void consider(double number) {
    if (!have_same_bits(number / kWhite, component_)) return;
    const std::size_t size = to_text(number).size();
    if (size >= size_) return;
    size_ = size;
    number_ = number;
  }
  bool is_found() const noexcept { return size_ != std::numeric_limits<std::size_t>::max(); }
  double number() const noexcept { return number_; }

 private:
  double component_;
  double number_ = 0;
  std::size_t size_ = std::numeric_limits<std::size_t>::max();
};

}  // namespace

bool have_same_bits(double a, double b) noexcept {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

std::string config_number(double number) {
  const bool is_negative_zero = number == 0 && std::signbit(number);
  return is_negative_zero ? "-0" : to_text(number);
}

ScaledComponent to_config_scale(double component, std::span<const double> preferred) {
  if (component == 0) return {.number = component};
  ShortestNumber best(component);
  auto next = std::ranges::lower_bound(preferred, component, {},
                                       [](double number) { return number / kWhite; });
  for (; next != preferred.end() && *next / kWhite == component; ++next) best.consider(*next);
  if (best.is_found()) return {.number = best.number()};

  // Division rounds by less than an ulp, so only these numbers can give the component.
  const double middle = component * kWhite;
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const double number :
       {middle, std::nextafter(middle, 0.0), std::nextafter(middle, kInfinity)}) {
    best.consider(number);
  }
  if (best.is_found()) return {.number = best.number()};
  return {.number = middle, .is_exact = false};
}

}  // namespace sdlc::lang
