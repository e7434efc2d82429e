#include "lang/json/config_scan.hpp"

namespace sdlc::lang {

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
  const Token token = token_at(i);
  return token.kind == TokenKind::Space ? token.span.size() : 0;
}

bool ConfigScan::begins_string(std::uint32_t i) const noexcept {
  return at(i) == '"' || at(i) == '\'' || is_curly(i);
}

std::uint32_t ConfigScan::end_of_string(std::uint32_t i) const noexcept {
  const Token token = token_at(i);
  return token.kind == TokenKind::String ? token.span.end : 0;
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
  const Token token = token_at(i);
  return token.kind == TokenKind::Name || token.kind == TokenKind::Number ? token.span.end : i;
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

}  // namespace sdlc::lang
