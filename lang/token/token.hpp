#pragma once

#include <cstdint>

#include "lang/source/source.hpp"

namespace sdlc::lang {

enum class TokenKind : std::uint8_t {
  // Trivia
  Space,    ///< within a line; at the beginning of the text also the byte order mark
  LineEnd,  ///< one: LF, CRLF or CR
  LineComment,
  DocComment,  ///< `///`
  BlockComment,
  UnclosedComment,  ///< a block comment, up to the end of the text

  Name,            ///< of the scene language: keywords too; of JSON: a word without quotes
  ForeignName,     ///< a name with letters that no name of the scene language has
  Number,          ///< with its unit, correct or not
  String,          ///< with its quotes, correct or not
  UnclosedString,  ///< up to the end of the line
  Color,           ///< `#` and what follows it
  Open,            ///< `(`, `[` or `{`
  Close,           ///< `)`, `]` or `}`
  Mark,            ///< an operator, a comma or a colon
  Unknown,         ///< one character that the language does not use, or a run of bytes that are no
                   ///< text
  End,             ///< the end of the text; empty
};

constexpr bool is_comment(TokenKind kind) noexcept {
  return kind >= TokenKind::LineComment && kind <= TokenKind::UnclosedComment;
}
/// Spaces, line ends and comments.
constexpr bool is_trivia(TokenKind kind) noexcept { return kind <= TokenKind::UnclosedComment; }
constexpr bool is_name(TokenKind kind) noexcept {
  return kind == TokenKind::Name || kind == TokenKind::ForeignName;
}
constexpr bool is_string(TokenKind kind) noexcept {
  return kind == TokenKind::String || kind == TokenKind::UnclosedString;
}

struct Token {
  Span span;
  TokenKind kind = TokenKind::End;
};

}  // namespace sdlc::lang
