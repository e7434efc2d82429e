#include "lang/json/near_json.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>

#include <fmt/format.h>

#include "lang/text/ascii.hpp"

namespace sdlc::lang {
namespace {

/// Takes the digits at the beginning of `text`.
std::string_view take_digits(std::string_view& text) {
  const auto end = std::find_if_not(text.begin(), text.end(), is_ascii_digit);
  const auto digits = text.substr(0, static_cast<std::size_t>(end - text.begin()));
  text.remove_prefix(digits.size());
  return digits;
}

bool take(std::string_view& text, std::string_view any_of) {
  if (text.empty() || any_of.find(text.front()) == std::string_view::npos) return false;
  text.remove_prefix(1);
  return true;
}

/// The text if it is an exponent or empty; else nullopt.
std::optional<std::string_view> exponent(std::string_view text) {
  const std::string_view whole = text;
  if (text.empty()) return whole;
  if (!take(text, "eE")) return std::nullopt;
  take(text, "+-");
  if (take_digits(text).empty() || !text.empty()) return std::nullopt;
  return whole;
}

/// The number without its sign, if it has the prefix of another base.
std::optional<NearNumber> near_number_with_base(std::string_view sign, std::string_view text) {
  struct Base {
    std::string_view prefix;
    int base;
  };
  constexpr auto kBases = std::to_array<Base>({{"0x", 16}, {"0o", 8}, {"0b", 2}});
  const std::string lower = lower_case(text);
  for (const auto& [prefix, base] : kBases) {
    if (!lower.starts_with(prefix)) continue;
    std::uint64_t value = 0;
    const char* end = lower.data() + lower.size();
    const auto result = std::from_chars(lower.data() + prefix.size(), end, value, base);
    const bool is_read = result.ec == std::errc() && result.ptr == end;
    const std::size_t digits = lower.size() - prefix.size();
    return NearNumber{"JSON has decimal numbers only",
                      is_read ? std::optional(fmt::format("{}{}", sign, value)) : std::nullopt,
                      base != 16 || (digits != 3 && digits != 6)};  // else perhaps a colour
  }
  return std::nullopt;
}

/// Whether each `_` in a number without sign separates groups of three digits before the point.
bool is_grouped_in_threes(std::string_view text) {
  const std::string_view first = take_digits(text);
  if (first.empty() || first.size() > 3) return false;
  while (take(text, "_")) {
    if (take_digits(text).size() != 3) return false;
  }
  return text.find('_') == std::string_view::npos;
}

}  // namespace

NearNumber near_number(std::string_view text) {
  constexpr std::string_view kForm = "numbers look like -1.5e3";
  const bool has_plus = text.starts_with('+');
  const std::string_view sign = text.starts_with('-') ? "-" : "";
  std::string_view rest = text.substr(has_plus || !sign.empty() ? 1 : 0);
  if (const auto number = near_number_with_base(sign, rest)) return *number;

  const bool has_threes = is_grouped_in_threes(rest);
  std::string ungrouped(rest);
  const bool is_grouped = std::erase(ungrouped, '_') > 0;
  rest = ungrouped;
  std::string_view whole = take_digits(rest);
  const bool has_point = take(rest, ".");
  const std::string_view fraction = take_digits(rest);
  const auto tail = exponent(rest);
  if (!tail || (whole.empty() && fraction.empty())) return {kForm, std::nullopt};

  const bool has_leading_zeros = whole.size() > 1 && whole.front() == '0';
  whole.remove_prefix(std::min(whole.find_first_not_of('0'), whole.size()));
  const std::string number = fmt::format("{}{}{}{}{}", sign, whole.empty() ? "0" : whole,
                                         fraction.empty() ? "" : ".", fraction, *tail);
  // `1_5` may be 1.5.
  const bool is_certain =
      !has_leading_zeros && !(has_point && fraction.empty()) && (!is_grouped || has_threes);
  if (has_plus) return {"a leading `+` is not allowed", number, is_certain};
  if (is_grouped) return {"digits cannot be grouped", number, is_certain};
  // A point may be missing in `05`, and digits in `0.`.
  if (has_leading_zeros) return {"leading zeros are not allowed", number, false};
  if (has_point && fraction.empty()) return {"a digit is missing after the point", number, false};
  return {"a digit is missing before the point", number};
}

std::optional<std::string_view> near_literal(std::string_view word) {
  const std::string lower = lower_case(word);
  if (lower == "true" || lower == "yes" || lower == "on") return "true";
  if (lower == "false" || lower == "no" || lower == "off") return "false";
  const bool is_null = lower == "null" || lower == "none" || lower == "nil" || lower == "undefined";
  return is_null ? std::optional<std::string_view>("null") : std::nullopt;
}

bool is_non_finite(std::string_view word) {
  if (word.starts_with('-') || word.starts_with('+')) word.remove_prefix(1);
  const std::string lower = lower_case(word);
  return lower == "nan" || lower == "inf" || lower == "infinity";
}

std::string quote_for_json(std::string_view content) {
  std::string text = "\"";
  for (std::size_t i = 0; i < content.size(); ++i) {
    const bool is_escape = content[i] == '\\' && i + 1 < content.size();
    if (is_escape && content[i + 1] == '\'') ++i;
    if (content[i] == '"') text += '\\';
    text += content[i];
    if (is_escape && content[i] == '\\') text += content[++i];
  }
  return text += '"';
}

}  // namespace sdlc::lang
