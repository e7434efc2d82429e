#pragma once

#include <cstdint>
#include <string_view>

#include "lang/text/ascii.hpp"

/// The characters of names in the scene language.
namespace sdlc::lang {

constexpr bool is_digit(char c) noexcept { return is_ascii_digit(c); }
constexpr bool is_letter(char c) noexcept { return is_ascii_letter(c) || c == '_'; }
constexpr bool is_idchar(char c) noexcept { return is_letter(c) || is_digit(c); }

/// The character at `at`; NUL beyond the end.
constexpr char char_at(std::string_view text, std::size_t at) noexcept {
  return at < text.size() ? text[at] : '\0';
}

/// The end of the identifier at `at`; `at` if none begins there.
constexpr std::uint32_t end_of_identifier(std::string_view text, std::uint32_t at) noexcept {
  if (!is_letter(char_at(text, at))) return at;
  while (is_idchar(char_at(text, at))) ++at;
  return at;
}

}  // namespace sdlc::lang
