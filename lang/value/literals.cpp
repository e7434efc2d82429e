#include "lang/value/literals.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string_view>

#include "lang/text/utf8.hpp"

namespace sdlc::lang {
namespace {

enum class Measure : std::uint8_t { Plain, Length, Time, Angle };

/// A unit. One of factor and divisor is 1, so that the product is rounded once.
struct UnitInfo {
  std::string_view name;
  Measure measure;
  double factor = 1;
  double divisor = 1;
};

constexpr double kDegreesPerRadian = 57.29577951308232;  // 180 / pi to the nearest double

constexpr auto kUnits = std::to_array<UnitInfo>({
    {.name = "%", .measure = Measure::Plain, .divisor = 100},
    {.name = "deg", .measure = Measure::Angle},
    {.name = "rad", .measure = Measure::Angle, .factor = kDegreesPerRadian},
    {.name = "turn", .measure = Measure::Angle, .factor = 360},
    {.name = "mm", .measure = Measure::Length, .divisor = 1000},
    {.name = "cm", .measure = Measure::Length, .divisor = 100},
    {.name = "m", .measure = Measure::Length},
    {.name = "km", .measure = Measure::Length, .factor = 1000},
    {.name = "ms", .measure = Measure::Time, .divisor = 1000},
    {.name = "s", .measure = Measure::Time},
});

/// The offset of the unit, which follows the last digit (an exponent ends in a digit).
std::size_t begin_of_unit(std::string_view text) {
  std::size_t at = text.size();
  while (at > 0 && !(text[at - 1] >= '0' && text[at - 1] <= '9')) --at;
  return at;
}

/// Whether the decimal number is at least 1. from_chars reports overflow and underflow by the same
/// error; this distinguishes them.
bool is_at_least_one(std::string_view digits) {
  const std::size_t e = std::min(digits.find_first_of("eE"), digits.size());
  const std::string_view mantissa = digits.substr(0, e);
  const std::size_t point = std::min(mantissa.find('.'), mantissa.size());
  const std::size_t first = mantissa.find_first_of("123456789");
  if (first == std::string_view::npos) return false;
  // The decimal exponent of the first digit that is not 0: 0 for ones, -1 for tenths.
  const auto place = first < point
                         ? static_cast<std::int64_t>(point - first) - 1
                         : static_cast<std::int64_t>(point) - static_cast<std::int64_t>(first);
  if (e == digits.size()) return place >= 0;
  const bool is_negative = digits[e + 1] == '-';
  std::int64_t exponent = 0;
  for (const char c : digits.substr(e + 1)) {
    if (c >= '0' && c <= '9')
      exponent = std::min<std::int64_t>(exponent * 10 + (c - '0'), 1'000'000'000'000);
  }
  return place + (is_negative ? -exponent : exponent) >= 0;
}

}  // namespace

std::optional<double> parse_decimal(std::string_view digits) {
  std::string joined;
  if (digits.find('_') != std::string_view::npos) {
    std::copy_if(digits.begin(), digits.end(), std::back_inserter(joined),
                 [](char c) { return c != '_'; });
    digits = joined;
  }
  double value = 0;
  const auto result = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (result.ec == std::errc()) return value;
  if (is_at_least_one(digits)) return std::nullopt;
  return 0.0;
}

namespace {

char32_t parse_hex(std::string_view digits) {
  std::uint32_t value = 0;
  std::from_chars(digits.data(), digits.data() + digits.size(), value, 16);
  return value;
}

/// The code point of the escape `\uXXXX` at `i`, or of a surrogate pair of two; `i` moves to the
/// end. nullopt for an unpaired surrogate.
std::optional<char32_t> take_unicode_escape(std::string_view text, std::size_t& i) {
  constexpr std::size_t kSize = 6;
  const char32_t first = parse_hex(text.substr(i + 2, 4));
  i += kSize;
  const bool is_surrogate = first >= 0xD800 && first < 0xE000;
  if (!is_surrogate) return first;
  const char32_t second = text.substr(i, 2) == "\\u" ? parse_hex(text.substr(i + 2, 4)) : 0;
  const bool is_pair = first < 0xDC00 && second >= 0xDC00 && second < 0xE000;
  if (!is_pair) return std::nullopt;
  i += kSize;
  return 0x10000 + ((first - 0xD800) << 10) + (second - 0xDC00);
}

/// The character of an escape of one letter, such as `\n`.
char unescaped(char letter) {
  switch (letter) {
    case 'b': return '\b';
    case 'f': return '\f';
    case 'n': return '\n';
    case 'r': return '\r';
    case 't': return '\t';
    default: return letter;
  }
}

}  // namespace

Value evaluate_number(ast::Node node, DiagnosticSink& sink) {
  const std::string_view text = node.text();
  const std::size_t unit_begin = begin_of_unit(text);
  const std::optional<double> number = parse_decimal(text.substr(0, unit_begin));
  const std::string_view unit_name = text.substr(unit_begin);

  UnitInfo unit{.name = "", .measure = Measure::Plain};
  if (!unit_name.empty()) {
    unit = *std::find_if(kUnits.begin(), kUnits.end(),
                         [&](const UnitInfo& info) { return info.name == unit_name; });
  }
  const double value = number.value_or(HUGE_VAL) * unit.factor / unit.divisor;
  if (!std::isfinite(value)) {
    sink.report(diag::number_too_large, node.location(), text.size() <= 40 ? text : "this number");
    return Nothing{};
  }
  switch (unit.measure) {
    case Measure::Plain: return Scalar{value};
    case Measure::Length: return Scalar{value, Unit::Length};
    case Measure::Time: return Scalar{value, Unit::Time};
    case Measure::Angle: return Angle{value};
  }
  return Nothing{};
}

Value evaluate_string(ast::Node node, DiagnosticSink& sink) {
  const Span inside{node.span().begin + 1, node.span().end - 1};
  const std::string_view text = node.tree().text(inside);
  std::string value;
  for (std::size_t i = 0; i < text.size();) {
    if (text[i] != '\\') {
      const std::size_t next = std::min(text.find('\\', i), text.size());
      value += text.substr(i, next - i);
      i = next;
      continue;
    }
    if (text[i + 1] != 'u') {
      value += unescaped(text[i + 1]);
      i += 2;
      continue;
    }
    const auto begin = static_cast<std::uint32_t>(i);
    const auto c = take_unicode_escape(text, i);
    if (!c) {
      const Span escape{inside.begin + begin, inside.begin + static_cast<std::uint32_t>(i)};
      sink.report(diag::bad_string, node.tree().location(escape), "an unpaired surrogate");
      return Nothing{};
    }
    append_utf8(*c, value);
  }
  return value;
}

bool check_string_size(std::uint64_t bytes, const Limits& limits, Location where,
                       DiagnosticSink& sink) {
  if (bytes <= limits.string) return true;
  sink.report(diag::string_too_long, where, limits.string).help("`--limit string=N` allows more");
  return false;
}

}  // namespace sdlc::lang
