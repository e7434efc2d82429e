#include "cli/report/axis.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>

namespace sdlc::cli {

LogAxis::LogAxis(std::span<const double> values)
    : from_(std::numeric_limits<double>::infinity()), to_(-from_) {
  for (const double value : values) {
    if (!(value > 0) || !std::isfinite(value)) continue;
    from_ = std::min(from_, std::log10(value));
    to_ = std::max(to_, std::log10(value));
  }
  if (from_ > to_) from_ = to_ = 0;
  constexpr double kMargin = 0.04;
  const double half = std::max(to_ - from_, 1.0) * (0.5 + kMargin), center = (from_ + to_) / 2;
  from_ = center - half;
  to_ = center + half;
}

double LogAxis::share(double value) const noexcept {
  if (!(value > 0)) return 0;
  return std::clamp((std::log10(value) - from_) / (to_ - from_), 0.0, 1.0);
}

std::vector<double> LogAxis::ticks(std::size_t max_count) const {
  const auto multiples = [&](std::initializer_list<double> factors, int step) {
    std::vector<double> values;
    const int first = static_cast<int>(std::floor(from_)), last = static_cast<int>(std::ceil(to_));
    for (int exponent = first; exponent <= last; ++exponent) {
      if (exponent % step != 0) continue;
      for (const double factor : factors) {
        const double value = factor * std::pow(10.0, exponent), log = std::log10(value);
        if (std::isfinite(log) && log >= from_ && log <= to_) values.push_back(value);
      }
    }
    return values;
  };
  std::vector<double> ticks = multiples({1, 2, 5}, 1);
  for (int step = 1; ticks.size() > max_count; ++step) ticks = multiples({1}, step);
  return ticks;
}

}  // namespace sdlc::cli
