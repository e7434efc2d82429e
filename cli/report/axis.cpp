#include "cli/report/axis.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace sdlc::cli {
namespace {

constexpr std::array kOnes{1.0};
constexpr std::array kOneThree{1.0, 3.0};
constexpr std::array kOneTwoFive{1.0, 2.0, 5.0};
constexpr std::array kAll{1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0};

/// The multiples of every `step`th power of ten within the range.
std::vector<double> multiples_within(double from, double to, std::span<const double> multiples,
                                     int step = 1) {
  std::vector<double> values;
  const int first = static_cast<int>(std::floor(std::log10(from)));
  const int last = static_cast<int>(std::ceil(std::log10(to)));
  for (int exponent = first; exponent <= last; ++exponent) {
    if (exponent % step != 0) continue;
    for (const double multiple : multiples) {
      // Divided by an integer power, so that 0.2 is correctly rounded.
      const double value =
          exponent < 0 ? multiple / std::pow(10.0, -exponent) : multiple * std::pow(10.0, exponent);
      if (value >= from && value <= to) values.push_back(value);
    }
  }
  return values;
}

/// Even steps of 1, 2 or 5 times a power of ten: three to seven of them.
std::vector<double> even_steps(double from, double to) {
  constexpr int kMaxLabels = 6;
  const double rough = (to - from) / kMaxLabels;
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  double step = 10 * power;
  for (const double multiple : {5.0, 2.0}) {
    if (multiple * power >= rough) step = multiple * power;
  }
  std::vector<double> values;
  for (double k = std::ceil(from / step); k * step <= to; ++k) values.push_back(k * step);
  return values;
}

std::vector<double> labelled_values(double from, double to, std::size_t max_count) {
  std::vector<double> values = multiples_within(from, to, kOneTwoFive);
  if (values.size() < 3) return even_steps(from, to);
  if (values.size() > max_count) values = multiples_within(from, to, kOneThree);
  for (int step = 1; values.size() > max_count; ++step) {
    values = multiples_within(from, to, kOnes, step);
  }
  return values;
}

}  // namespace

LogAxis LogAxis::covering(std::span<const double> values) {
  double smallest = std::numeric_limits<double>::infinity(), largest = 0;
  for (const double value : values) {
    if (!(value > 0) || !std::isfinite(value)) continue;
    smallest = std::min(smallest, value);
    largest = std::max(largest, value);
  }
  if (largest == 0) smallest = largest = 1;
  // If the range is beyond a double, keep its ends.
  constexpr double kMinSpan = 1.5, kMargin = 0.04;
  double from = smallest, to = largest;
  if (to / from < kMinSpan) {
    const double middle = std::sqrt(from) * std::sqrt(to);
    from = middle / std::sqrt(kMinSpan);
    to = std::min(middle * std::sqrt(kMinSpan), std::numeric_limits<double>::max());
  }
  const double margin = std::pow(to / from, kMargin);
  if (std::isfinite(margin) && std::isfinite(to * margin) && from / margin > 0) {
    from /= margin;
    to *= margin;
  }
  return LogAxis(from, to);
}

double LogAxis::share(double value) const noexcept {
  if (!(value > from_)) return 0;
  if (value >= to_) return 1;
  return (std::log(value) - std::log(from_)) / (std::log(to_) - std::log(from_));
}

std::vector<Tick> LogAxis::ticks(std::size_t max_labels) const {
  std::vector<Tick> ticks;
  for (const double value : labelled_values(from_, to_, max_labels)) ticks.push_back({value, true});
  constexpr double kMaxForMinor = 1e5;
  if (to_ / from_ > kMaxForMinor) return ticks;
  for (const double value : multiples_within(from_, to_, kAll)) {
    if (std::ranges::find(ticks, value, &Tick::value) == ticks.end())
      ticks.push_back({value, false});
  }
  std::ranges::sort(ticks, {}, &Tick::value);
  return ticks;
}

}  // namespace sdlc::cli
