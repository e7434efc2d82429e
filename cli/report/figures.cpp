#include "cli/report/figures.hpp"

#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

#include "cli/numbers/format_numbers.hpp"

namespace sdlc::cli {
namespace {

constexpr std::string_view kUnknown = "unknown";
constexpr std::string_view kSpace = "\u00a0";

}  // namespace

std::string figure(double number) {
  if (!std::isfinite(number)) return std::string(kUnknown);
  const std::string rounded = fmt::format("{:.2e}", number + 0.0);  // no negative zero
  return fmt::format("{}", std::strtod(rounded.c_str(), nullptr));
}

std::string whole(double count) { return format_whole(static_cast<std::uint64_t>(count)); }

std::string percent(double share) {
  if (!std::isfinite(share)) return std::string(kUnknown);
  return fmt::format("{}{}%", figure(100 * share), kSpace);
}

std::string duration(double seconds) {
  constexpr double kLongest = 1e12;  // beyond any useful number of seconds
  if (!(seconds >= 0 && seconds < kLongest)) return std::string(kUnknown);
  // With one decimal the ends of an interval of a few seconds are often equal.
  if (seconds >= 1 && seconds < 60) return fmt::format("{}{}s", figure(seconds), kSpace);
  std::string text;
  for (const char c : format_seconds(seconds)) text += c == ' ' ? kSpace : std::string_view(&c, 1);
  return text;
}

std::string times(double ratio) {
  return std::isfinite(ratio) ? fmt::format("{}{}times", figure(ratio), kSpace)
                              : std::string(kUnknown);
}

std::string rate(double per_second) {
  return std::isfinite(per_second) && per_second >= 0 ? format_count(per_second)
                                                      : std::string(kUnknown);
}

std::string Reading::text() const {
  return interval.empty() ? value : fmt::format("{} ({})", value, interval);
}

Reading read(const render::Measured& measured, FigureText* as) {
  Reading reading{.value = as(measured.value), .interval = {}};
  if (!has_interval(measured)) return reading;
  std::string from = as(measured.interval.from);
  const std::string to = as(measured.interval.to);
  if (!std::isfinite(measured.interval.to)) {
    reading.interval = fmt::format("at least {}", from);
    return reading;
  }
  // "8.1 to 10 s", but "58.2 s to 1 min 02 s".
  const auto unit = [](std::string_view text) {
    const std::size_t space = text.find(kSpace);
    return space == std::string_view::npos ? std::string_view() : text.substr(space);
  };
  if (unit(from) == unit(to)) from.resize(from.size() - unit(from).size());
  reading.interval = fmt::format("{} to {}", from, to);
  return reading;
}

bool has_interval(const render::Measured& measured) noexcept {
  const auto [from, to] = measured.interval;
  return std::isfinite(from) && from < to;
}

}  // namespace sdlc::cli
