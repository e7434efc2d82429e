#pragma once

#include <concepts>
#include <cstdint>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "cli/numbers/format_numbers.hpp"
#include "render/measure/measurement.hpp"

/// Measured numbers formatted for the page.
namespace sdlc::cli {

/// With three significant digits: "0.98", "1230", "-2.14e-06"; "unknown" if not finite.
std::string figure(double number);
/// "1,024"
std::string whole(double count);
/// A share in percent, with a no-break space: "0.98 %".
std::string percent(double share);
/// Like format_seconds(), but with three digits below a minute; "unknown" if invalid.
std::string duration(double seconds);
/// "1.04 times"
std::string times(double ratio);
/// Per second, with a metric prefix: "7.12 M"; "unknown" if invalid.
std::string rate(double per_second);

/// "1 sample", "1,024 samples"
template <std::integral T>
std::string count_of(T count, std::string_view noun) {
  const std::string number = format_whole(static_cast<std::uint64_t>(count));
  return fmt::format("{} {}{}", number, noun, count == 1 ? "" : "s");
}

/// A figure and its interval, separately: "0.98 %" and "0.96 to 1.01 %".
struct Reading {
  std::string value;
  std::string interval;  ///< empty if there is none

  /// "0.98 % (0.96 to 1.01 %)"
  std::string text() const;
};

using FigureText = std::string(double);

/// Formats value and ends with `as`; a common unit of both ends is written once.
Reading read(const render::Measured& measured, FigureText* as);

/// Whether the ends are informative: they are numbers and differ. The upper one may be infinite.
bool has_interval(const render::Measured& measured) noexcept;

}  // namespace sdlc::cli
