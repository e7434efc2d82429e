#include "cli/amounts.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <iterator>
#include <optional>
#include <string_view>
#include <system_error>

#include <fmt/format.h>

#include "cli/command_line.hpp"
#include "lang/text/ascii.hpp"
#include "lang/text/display_width.hpp"

namespace sdlc::cli {
namespace {

/// A number and the unit directly after it.
struct Amount {
  double number;
  std::string_view digits, unit;
};

/// nullopt if the text does not begin with a positive finite number.
std::optional<Amount> read_amount(std::string_view text) {
  // from_chars also accepts signs and words.
  if (text.empty() || !(lang::is_ascii_digit(text[0]) || text[0] == '.')) return std::nullopt;
  Amount amount{};
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), amount.number);
  if (error != std::errc() || !(amount.number > 0)) return std::nullopt;
  amount.digits = text.substr(0, static_cast<std::size_t>(stop - text.data()));
  amount.unit = text.substr(amount.digits.size());
  return amount;
}

std::optional<double> read_share(std::string_view text) {
  const std::optional<Amount> amount = read_amount(text);
  if (!amount || !(amount->unit.empty() || amount->unit == "%")) return std::nullopt;
  const double share = amount->unit.empty() ? amount->number : amount->number / 100;
  return share > 0 && share <= 1 ? std::optional(share) : std::nullopt;
}

struct TimeUnit {
  std::string_view name;
  double factor, divisor;  // one of them is 1, so that there is a single rounding
};

constexpr std::array kTimeUnits{TimeUnit{"ms", 1, 1000}, TimeUnit{"s", 1, 1},
                                TimeUnit{"min", 60, 1}, TimeUnit{"h", 3600, 1}};

std::optional<double> read_duration(std::string_view text) {
  const std::optional<Amount> amount = read_amount(text);
  if (!amount) return std::nullopt;
  const auto unit = std::ranges::find(kTimeUnits, amount->unit, &TimeUnit::name);
  if (unit == kTimeUnits.end()) return std::nullopt;
  const double seconds = amount->number * unit->factor / unit->divisor;
  return seconds > 0 && std::isfinite(seconds) ? std::optional(seconds) : std::nullopt;
}

std::string without_spaces(std::string_view text) {
  std::string joined;
  std::ranges::copy_if(text, std::back_inserter(joined), [](char c) { return c != ' '; });
  return joined;
}

/// The unit that begins like the word: "s" for "seconds".
std::string_view nearest_unit(std::string_view word) {
  struct Beginning {
    std::string_view text, unit;
  };
  static constexpr std::array kBeginnings{Beginning{"ms", "ms"}, Beginning{"mil", "ms"},
                                          Beginning{"m", "min"}, Beginning{"s", "s"},
                                          Beginning{"h", "h"}};
  if (word.empty()) return "s";
  if (!std::ranges::all_of(word, lang::is_ascii_letter)) return {};
  const std::string lower = lang::lower_case(word);
  const auto found = std::ranges::find_if(
      kBeginnings, [&](const Beginning& beginning) { return lower.starts_with(beginning.text); });
  return found == kBeginnings.end() ? std::string_view() : found->unit;
}

/// Guesses the intended share by adding the missing `%`; the result may still be invalid.
std::string repair_share(std::string_view text) {
  const std::string joined = without_spaces(text);
  return read_share(joined) ? joined : joined + "%";
}
std::string repair_duration(std::string_view text) {
  const std::string joined = without_spaces(text);
  const std::optional<Amount> amount = read_amount(joined);
  if (!amount) return joined;
  return fmt::format("{}{}", amount->digits, nearest_unit(amount->unit));
}

double parse_amount(const std::string& flag, const std::string& text, std::string_view wanted,
                    std::optional<double> (*read)(std::string_view),
                    std::string (*repair)(std::string_view)) {
  if (const auto amount = read(text)) return *amount;
  const std::string repaired = repair(text);
  throw ArgumentError(
      flag, fmt::format("takes {}, not `{}`{}", wanted, lang::printable(text),
                        read(repaired) ? fmt::format(" (did you mean `{}`?)", repaired) : ""));
}

std::optional<double> read_finite(const std::string& text) {
  double number = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  const bool is_number = error == std::errc() && stop == end && std::isfinite(number);
  return is_number ? std::optional(number) : std::nullopt;
}

[[noreturn]] void refuse_number(const std::string& flag, const std::string& text,
                                std::string_view wanted) {
  throw ArgumentError(flag, fmt::format("takes {}, not `{}`", wanted, lang::printable(text)));
}

}  // namespace

double parse_share(const std::string& flag, const std::string& text) {
  return parse_amount(flag, text, "a share above 0 and at most 100%, such as `3%` or `0.03`",
                      read_share, repair_share);
}

double parse_ratio(const std::string& flag, const std::string& text) {
  const bool is_percentage = text.ends_with('%');
  const auto number = read_finite(is_percentage ? text.substr(0, text.size() - 1) : text);
  if (number && *number >= 0) return is_percentage ? *number / 100 : *number;
  refuse_number(flag, text, "a ratio from 0 on, such as `3%`, `0.03` or `250%`");
}

double parse_duration(const std::string& flag, const std::string& text) {
  return parse_amount(flag, text,
                      "a time above 0 with its unit, such as `10s`, `500ms`, `2min` or `1h`",
                      read_duration, repair_duration);
}

double parse_number(const std::string& flag, const std::string& text, double min) {
  const auto number = read_finite(text);
  if (number && *number >= min) return *number;
  refuse_number(flag, text, fmt::format("a number from {} on, such as `{}`", min, min + 0.5));
}

double parse_signed_number(const std::string& flag, const std::string& text) {
  if (const auto number = read_finite(text)) return *number;
  refuse_number(flag, text, "a number, such as `-0.5`");
}

double parse_positive_number(const std::string& flag, const std::string& text) {
  const auto number = read_finite(text);
  if (number && *number > 0) return *number;
  refuse_number(flag, text, "a number above 0, such as `0.5`");
}

}  // namespace sdlc::cli
