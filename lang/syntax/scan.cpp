#include "lang/syntax/scan.hpp"

#include <algorithm>

namespace sdlc::lang {
namespace {

constexpr std::uint32_t as_offset(std::size_t at, std::string_view text) noexcept {
  return static_cast<std::uint32_t>(std::min(at, text.size()));
}

}  // namespace

bool is_foreign_letter(std::string_view text, std::uint32_t at) noexcept {
  // These blocks of U+00C0 to U+052F have two bytes each, the first of which tells them.
  const auto lead = static_cast<unsigned char>(char_at(text, at));
  const auto next = static_cast<unsigned char>(char_at(text, at + 1));
  if (lead < 0xC3 || lead > 0xD4 || (next & 0xC0) != 0x80) return false;
  const bool is_sign = lead == 0xC3 && (next == 0x97 || next == 0xB7);  // times, divided by
  return !is_sign;
}

std::uint32_t end_of_identifier(std::string_view text, std::uint32_t at) noexcept {
  if (!is_letter(char_at(text, at))) return at;
  while (is_idchar(char_at(text, at))) ++at;
  return at;
}

std::uint32_t skip_blanks(std::string_view text, std::uint32_t at) noexcept {
  while (char_at(text, at) == ' ' || char_at(text, at) == '\t' || char_at(text, at) == '\r') ++at;
  return at;
}

std::uint32_t skip_space(std::string_view text, std::uint32_t at) noexcept {
  while (true) {
    const std::uint32_t before = at;
    at = end_of_comment(text, skip_blanks(text, at));
    if (char_at(text, at) == '\n') ++at;
    if (at == before) return at;
  }
}

std::uint32_t end_of_comment(std::string_view text, std::uint32_t at) noexcept {
  if (char_at(text, at) != '/') return at;
  if (char_at(text, at + 1) == '/') return as_offset(text.find('\n', at), text);
  if (char_at(text, at + 1) != '*') return at;
  std::size_t depth = 0;
  for (std::size_t i = at; i + 1 < text.size();) {
    if (text[i] == '/' && text[i + 1] == '*') {
      ++depth;
      i += 2;
    } else if (text[i] == '*' && text[i + 1] == '/') {
      i += 2;
      if (--depth == 0) return static_cast<std::uint32_t>(i);
    } else {
      ++i;
    }
  }
  return as_offset(text.size(), text);
}

std::uint32_t end_of_string(std::string_view text, std::uint32_t at) noexcept {
  if (char_at(text, at) != '"') return at;
  for (++at; at < text.size() && text[at] != '\n'; ++at) {
    if (text[at] == '"') return at + 1;
    if (text[at] == '\\' && at + 1 < text.size() && text[at + 1] != '\n') ++at;
  }
  return at;
}

std::uint32_t end_of_unclosed_string(std::string_view text, std::uint32_t at) noexcept {
  const std::size_t last = text.find_last_not_of(" \t\r)]},", end_of_string(text, at) - 1);
  return std::max(at + 1, as_offset(last + 1, text));
}

std::uint32_t end_of_opaque(std::string_view text, std::uint32_t at) noexcept {
  return char_at(text, at) == '"' ? end_of_string(text, at) : end_of_comment(text, at);
}

std::uint32_t end_of_bracket(std::string_view text, std::uint32_t at) noexcept {
  std::size_t depth = 0;
  for (std::uint32_t i = at; i < text.size();) {
    const std::uint32_t behind = end_of_opaque(text, i);
    if (behind > i) {
      i = behind;
      continue;
    }
    const char c = text[i++];
    if (c == '(' || c == '[' || c == '{') ++depth;
    if ((c == ')' || c == ']' || c == '}') && --depth == 0) return i;
  }
  return at;
}

Span token_at(std::string_view text, std::uint32_t at) noexcept {
  if (at >= text.size()) return {at, at};
  std::uint32_t end = end_of_string(text, at);
  if (end > at) return {at, end};
  while (is_idchar(char_at(text, end))) ++end;
  if (end > at) return {at, end};
  ++end;
  while ((static_cast<unsigned char>(char_at(text, end)) & 0xC0) == 0x80) ++end;
  return {at, end};
}

std::uint32_t line_begin(std::string_view text, std::uint32_t at) noexcept {
  if (at == 0) return 0;
  const std::size_t newline = text.rfind('\n', at - 1);
  return newline == std::string_view::npos ? 0 : static_cast<std::uint32_t>(newline + 1);
}

std::uint32_t indent_of_line(std::string_view text, std::uint32_t at) noexcept {
  const std::uint32_t begin = line_begin(text, at);
  return skip_blanks(text, begin) - begin;
}

bool is_first_of_line(std::string_view text, std::uint32_t at) noexcept {
  while (at > 0 && (text[at - 1] == ' ' || text[at - 1] == '\t' || text[at - 1] == '\r')) --at;
  return at == 0 || text[at - 1] == '\n';
}

}  // namespace sdlc::lang
