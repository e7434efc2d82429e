#include "lang/value/literals.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string_view>

namespace sdlc::lang {
namespace {

enum class Measure : std::uint8_t { Plain, Length, Time, Angle };

/// A unit: its number is multiplied by one factor or divided by one, exactly rounded (ruling 2).
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

/// The offset of the unit: `%` and letters after the last digit.
/// An `e` of the exponent is followed by digits.
std::size_t begin_of_unit(std::string_view text) {
  std::size_t at = text.size();
  while (at > 0 && !(text[at - 1] >= '0' && text[at - 1] <= '9')) --at;
  return at;
}

/// from_chars says "out of range" of what is too large and of what is too small. Whether the
/// decimal number is at least 1 tells them apart.
bool is_at_least_one(std::string_view digits) {
  const std::size_t e = std::min(digits.find_first_of("eE"), digits.size());
  const std::string_view mantissa = digits.substr(0, e);
  const std::size_t point = std::min(mantissa.find('.'), mantissa.size());
  const std::size_t first = mantissa.find_first_of("123456789");
  if (first == std::string_view::npos) return false;
  // The place of the first digit that is not 0: 0 for ones, -1 for tenths.
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

std::optional<double> parse_digits(std::string_view digits) {
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

void append_utf8(std::string& out, char32_t c) {
  const auto tail = [&](int shift) { out += static_cast<char>(0x80 | (c >> shift & 0x3F)); };
  if (c < 0x80) {
    out += static_cast<char>(c);
  } else if (c < 0x800) {
    out += static_cast<char>(0xC0 | c >> 6);
    tail(0);
  } else if (c < 0x10000) {
    out += static_cast<char>(0xE0 | c >> 12);
    tail(6), tail(0);
  } else {
    out += static_cast<char>(0xF0 | c >> 18);
    tail(12), tail(6), tail(0);
  }
}

char32_t parse_hex(std::string_view digits) {
  std::uint32_t value = 0;
  std::from_chars(digits.data(), digits.data() + digits.size(), value, 16);
  return value;
}

}  // namespace

Value evaluate_number(ast::Node node, DiagnosticSink& sink) {
  const std::string_view text = node.text();
  const std::size_t unit_begin = begin_of_unit(text);
  const std::optional<double> number = parse_digits(text.substr(0, unit_begin));
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
    const std::size_t begin = i;
    const char escape = text[i + 1];
    i += 2;
    switch (escape) {
      case 'b': value += '\b'; break;
      case 'f': value += '\f'; break;
      case 'n': value += '\n'; break;
      case 'r': value += '\r'; break;
      case 't': value += '\t'; break;
      case 'u': {
        char32_t c = parse_hex(text.substr(i, 4));
        i += 4;
        const bool is_first = c >= 0xD800 && c < 0xDC00;
        const char32_t second =
            is_first && text.substr(i, 2) == "\\u" ? parse_hex(text.substr(i + 2, 4)) : 0;
        if (second >= 0xDC00 && second < 0xE000) {
          c = 0x10000 + ((c - 0xD800) << 10) + (second - 0xDC00);
          i += 6;
        } else if (c >= 0xD800 && c < 0xE000) {
          const auto at = [&](std::size_t offset) {
            return inside.begin + static_cast<std::uint32_t>(offset);
          };
          sink.report(diag::bad_string, node.tree().location({at(begin), at(i)}),
                      "half of a surrogate pair");
          return Nothing{};
        }
        append_utf8(value, c);
        break;
      }
      default: value += escape;
    }
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
