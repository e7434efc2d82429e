#pragma once

#include <cstdint>
#include <string_view>

#include "lang/source/source.hpp"
#include "lang/text/ascii.hpp"

/// Looking at a text around a mistake, token by token, without the grammar.
namespace sdlc::lang {

constexpr bool is_digit(char c) noexcept { return is_ascii_digit(c); }
/// Of identifiers.
constexpr bool is_letter(char c) noexcept { return is_ascii_letter(c) || c == '_'; }
constexpr bool is_idchar(char c) noexcept { return is_letter(c) || is_digit(c); }

/// The character at `at`; NUL behind the end.
constexpr char char_at(std::string_view text, std::size_t at) noexcept {
  return at < text.size() ? text[at] : '\0';
}

/// Whether a letter begins at `at` that no identifier has: of Latin with accents, Greek, Cyrillic.
bool is_foreign_letter(std::string_view text, std::uint32_t at) noexcept;
/// Behind the identifier that begins at `at`; `at` if none does.
std::uint32_t end_of_identifier(std::string_view text, std::uint32_t at) noexcept;
/// Behind spaces, tabs and carriage returns.
std::uint32_t skip_blanks(std::string_view text, std::uint32_t at) noexcept;
/// Behind blanks, line ends and comments.
std::uint32_t skip_space(std::string_view text, std::uint32_t at) noexcept;
/// Behind the comment that begins at `at`; `at` if none does.
std::uint32_t end_of_comment(std::string_view text, std::uint32_t at) noexcept;
/// Behind the string that begins at `at`, closed or at the end of its line; `at` if none does.
std::uint32_t end_of_string(std::string_view text, std::uint32_t at) noexcept;
/// Where a string ends that is never closed, without the brackets at the end of its line: they were
/// hardly meant to be part of it. Precondition: `"` at `at`.
std::uint32_t end_of_unclosed_string(std::string_view text, std::uint32_t at) noexcept;
/// Behind the comment or string that begins at `at`; `at` if none does.
std::uint32_t end_of_opaque(std::string_view text, std::uint32_t at) noexcept;
/// Behind the bracket that matches the one at `at`; `at` if none does.
std::uint32_t end_of_bracket(std::string_view text, std::uint32_t at) noexcept;

/// The token at `at` as a caret should underline it: a word, a number, a string, or one character,
/// which may have several bytes. Empty at the end of the text.
Span token_at(std::string_view text, std::uint32_t at) noexcept;

std::uint32_t line_begin(std::string_view text, std::uint32_t at) noexcept;
/// Bytes of blank at the beginning of the line that holds `at`.
std::uint32_t indent_of_line(std::string_view text, std::uint32_t at) noexcept;
/// Whether only blanks stand in front of `at` in its line.
bool is_first_of_line(std::string_view text, std::uint32_t at) noexcept;

}  // namespace sdlc::lang
