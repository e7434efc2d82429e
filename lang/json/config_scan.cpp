#include "lang/json/config_scan.hpp"

#include "lang/text/utf8.hpp"

namespace sdlc::lang {
namespace {

constexpr std::uint32_t kCurlySize = 3;  // of a curly quote in UTF-8

bool is_foreign_blank(char32_t c) {
  return c == 0x0B || c == 0x0C || c == 0xA0 || (c >= 0x2000 && c <= 0x200B) || c == 0x202F ||
         c == 0x205F || c == 0x3000 || c == 0xFEFF;
}

}  // namespace

std::uint32_t ConfigScan::skip_blanks(std::uint32_t i) const noexcept {
  while (is_one_of(at(i), " \t")) ++i;
  return i;
}

std::uint32_t ConfigScan::skip_lines(std::uint32_t i) const noexcept {
  while (is_one_of(at(i), " \t\r\n")) ++i;
  return i;
}

bool ConfigScan::ends_line(std::uint32_t i) const noexcept {
  return i >= text_.size() || text_[i] == '\n' || text_[i] == '\r';
}

std::uint32_t ConfigScan::foreign_blank(std::uint32_t i) const noexcept {
  const char c = at(i);
  if (c != 0x0B && c != 0x0C && static_cast<unsigned char>(c) < 0x80) return 0;
  if (i >= text_.size()) return 0;
  const DecodedChar decoded = decode_utf8(text_.substr(i));
  return decoded.is_valid && is_foreign_blank(decoded.code_point) ? decoded.size : 0;
}

bool ConfigScan::begins_string(std::uint32_t i) const noexcept {
  return at(i) == '"' || at(i) == '\'' || is_curly(i);
}

std::uint32_t ConfigScan::end_of_string(std::uint32_t i) const noexcept {
  const char quote = text_[i];
  if (quote == '\xE2') return end_of_curly(i);
  for (++i; !ends_line(i); ++i) {
    if (text_[i] == '\\' && !ends_line(i + 1)) {
      ++i;
    } else if (text_[i] == quote) {
      return i + 1;
    }
  }
  return 0;
}

std::uint32_t ConfigScan::end_of_unclosed(std::uint32_t begin) const noexcept {
  std::uint32_t end = begin;
  while (!ends_line(end)) ++end;
  while (end > begin + quote_size(begin) && is_one_of(text_[end - 1], " \t,]}")) --end;
  return end;
}

bool ConfigScan::begins_word(std::uint32_t i) const noexcept {
  return is_ascii_letter(at(i)) || is_ascii_digit(at(i)) || is_one_of(at(i), "-+.");
}

std::uint32_t ConfigScan::end_of_word(std::uint32_t i) const noexcept {
  // 1/3 and 2*4 are one thing each.
  const bool is_number = !is_ascii_letter(at(i));
  while (is_word(at(i)) || (is_number && is_one_of(at(i), "/*") && is_ascii_digit(at(i + 1)))) ++i;
  return i;
}

bool ConfigScan::is_web_color(std::uint32_t i) const noexcept {
  constexpr std::uint32_t kMostDigits = 8;
  std::uint32_t end = i + 1;
  while (end <= i + kMostDigits + 1 && is_hex_digit(at(end))) ++end;
  const std::uint32_t digits = end - i - 1;
  const bool is_size = digits == 3 || digits == 4 || digits == 6 || digits == 8;
  return is_size && is_value_end(skip_blanks(end));
}

bool ConfigScan::is_curly(std::uint32_t i) const noexcept {
  return at(i) == '\xE2' && at(i + 1) == '\x80' && (at(i + 2) == '\x9C' || at(i + 2) == '\x9D');
}

std::uint32_t ConfigScan::end_of_curly(std::uint32_t i) const noexcept {
  for (i += kCurlySize; !ends_line(i); ++i) {
    if (is_curly(i)) return i + kCurlySize;
  }
  return 0;
}

}  // namespace sdlc::lang
