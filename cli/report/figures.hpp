#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "render/measure/measurement.hpp"

/// Measured numbers as they stand on the page.
namespace sdlc::cli {

/// So many significant digits at most: "0.98", "1230", "−2.1·10⁻⁶"; "unknown" where it is no finite
/// number.
std::string figure(double number, int digits = 3);

/// A share in percent, with a space that does not break: "0.98 %".
std::string percent(double share);
/// The same with as many digits as there are, for the ticks of an axis.
std::string percent_tick(double share);
/// As format_seconds() has it, but three digits of what is below a minute; "unknown" of what is no
/// time.
std::string duration(double seconds);
/// "1.04 times"
std::string times(double ratio);

/// "1 sample", "1,024 samples"
std::string count_of(std::uint64_t count, std::string_view noun);

/// A figure and its interval, apart: "0.98 %" and "0.96 to 1.01 %".
struct Reading {
  std::string value;
  std::string interval;  ///< empty where there is none

  /// "0.98 % (0.96 to 1.01 %)"
  std::string text() const;
};

using FigureText = std::string(double);

/// Reads value and ends each as `as` says; a unit that both ends share is said once.
Reading read(const render::Measured& measured, FigureText* as);

/// Whether the ends say anything: they are numbers and differ. The upper one may be infinite.
bool has_interval(const render::Measured& measured) noexcept;

}  // namespace sdlc::cli
