#include "cli/numbers/format_numbers.hpp"

#include <cstdlib>
#include <iterator>

#include <fmt/format.h>

#include "lang/object/value.hpp"

namespace sdlc::cli {
namespace {

/// Three digits with the largest unit that leaves at least 1; the first unit has the factor 1.
template <std::size_t N>
std::string with_unit(double amount, double step, const char* const (&units)[N]) {
  std::size_t unit = 0;
  for (; unit + 1 < N && amount >= step; ++unit) amount /= step;
  const int decimals = unit == 0 ? 0 : amount < 10 ? 2 : amount < 100 ? 1 : 0;
  return fmt::format("{:.{}f}{}", amount, decimals, units[unit]);
}

}  // namespace

std::string format_seconds(double seconds) {
  if (seconds < 0.01) return fmt::format("{:.2f} ms", 1000 * seconds);
  if (seconds < 1) return fmt::format("{:.0f} ms", 1000 * seconds);
  if (seconds < 60) return fmt::format("{:.1f} s", seconds);
  const auto whole = static_cast<std::uint64_t>(seconds);
  if (seconds < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole / 60 % 60);
}

std::string format_count(double count) {
  return with_unit(count, 1000, {"", " k", " M", " G", " T"});
}

std::string format_whole(std::uint64_t number) {
  const std::string digits = fmt::to_string(number);
  std::string text;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    if (i > 0 && (digits.size() - i) % 3 == 0) text += ',';
    text += digits[i];
  }
  return text;
}

std::string format_bytes(std::uint64_t bytes) {
  return with_unit(static_cast<double>(bytes), 1024, {" B", " KiB", " MiB", " GiB", " TiB"});
}

std::string format_rounded(double number) {
  return lang::to_text(std::strtod(fmt::format("{:.6g}", number).c_str(), nullptr));
}

}  // namespace sdlc::cli
