#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <string_view>

#include <fmt/format.h>

// What the headers of libc++ 16 declare and the library of emscripten lacks, for the calls of this
// project: the same texts as libstdc++ writes.
_LIBCPP_BEGIN_NAMESPACE_STD

namespace {

to_chars_result put(std::string_view text, char* first, char* last) {
  if (last - first < static_cast<std::ptrdiff_t>(text.size())) {
    return {last, errc::value_too_large};
  }
  std::memcpy(first, text.data(), text.size());
  return {first + text.size(), errc()};
}

}  // namespace

/// The fewest digits that give the same number again, in the shorter of both notations.
to_chars_result to_chars(char* first, char* last, double value) {
  if (isnan(value)) return put(signbit(value) ? "-nan" : "nan", first, last);
  if (isinf(value)) return put(value < 0 ? "-inf" : "inf", first, last);
  const std::string_view sign = signbit(value) ? "-" : "";
  if (value == 0) return put(fmt::format("{}0", sign), first, last);
  const auto decimal = fmt::detail::dragonbox::to_decimal(std::abs(value));
  const std::string digits = fmt::format("{}", decimal.significand);
  const int count = static_cast<int>(digits.size()), exponent = decimal.exponent;
  const bool is_fixed = count == 1 ? -3 <= exponent && exponent <= 4
                                   : -(count + 3) <= exponent && exponent <= 5;
  if (!is_fixed) {
    return put(fmt::format("{}{}{}{}e{:+03}", sign, digits[0], count > 1 ? "." : "",
                           digits.substr(1), exponent + count - 1),
               first, last);
  }
  if (exponent >= 0) return put(fmt::format("{:.0f}", value), first, last);
  const int whole = count + exponent;  // digits before the point
  if (whole > 0) {
    return put(fmt::format("{}{}.{}", sign, digits.substr(0, static_cast<std::size_t>(whole)),
                           digits.substr(static_cast<std::size_t>(whole))),
               first, last);
  }
  return put(fmt::format("{}0.{:0>{}}", sign, digits, -exponent), first, last);
}

to_chars_result to_chars(char* first, char* last, double value, chars_format format,
                         int precision) {
  // As printf; the longest double has 309 digits before the point.
  char text[512];
  const int size = std::snprintf(text, sizeof(text), format == chars_format::fixed ? "%.*f" : "%.*e",
                                 precision, value);
  return put({text, static_cast<std::size_t>(size)}, first, last);
}

_LIBCPP_END_NAMESPACE_STD
