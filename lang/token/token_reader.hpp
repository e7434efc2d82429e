#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "lang/source/source.hpp"
#include "lang/token/token.hpp"

namespace sdlc::lang {

/// The token of a scene at `at`. Any text has tokens; one after the other, they are the whole text.
Token scene_token(std::string_view text, std::uint32_t at) noexcept;
/// The token of a JSON text at `at`, likewise.
Token json_token(std::string_view text, std::uint32_t at) noexcept;

/// Reads tokens one by one and stores none, so that the size of the text does not matter. A copy
/// looks ahead.
class TokenReader {
 public:
  /// Begins with the token at `at`, which must not be within a comment or string.
  explicit TokenReader(std::string_view text, std::uint32_t at = 0,
                       SourceFormat format = SourceFormat::Scene) noexcept
      : text_(text), at_(at), format_(format) {}

  /// The next token, trivia included; at the end of the text End.
  Token next() noexcept {
    const Token token =
        format_ == SourceFormat::Scene ? scene_token(text_, at_) : json_token(text_, at_);
    at_ = token.span.end;
    return token;
  }
  /// The next token that is not Space: a line end or a comment is not skipped.
  Token next_in_line() noexcept {
    Token token = next();
    while (token.kind == TokenKind::Space) token = next();
    return token;
  }
  /// The next token that is no trivia.
  Token next_solid() noexcept {
    Token token = next();
    while (is_trivia(token.kind)) token = next();
    return token;
  }

  std::string_view text() const noexcept { return text_; }
  std::string_view text(const Token& token) const noexcept {
    return text_.substr(token.span.begin, token.span.size());
  }
  /// Where the next token begins.
  std::uint32_t at() const noexcept { return at_; }
  void seek(std::uint32_t at) noexcept { at_ = at; }

 private:
  std::string_view text_;
  std::uint32_t at_;
  SourceFormat format_;
};

/// All tokens of a text, without End.
std::vector<Token> tokenize(std::string_view text, SourceFormat format = SourceFormat::Scene);

/// Where the first token begins from `at` on that is no trivia.
std::uint32_t skip_space(std::string_view text, std::uint32_t at) noexcept;
/// The token of a scene at `at`; empty at the end of the text.
Span token_at(std::string_view text, std::uint32_t at) noexcept;
/// Where an unclosed string was probably meant to end: before the brackets and commas at the end of
/// its line.
std::uint32_t end_of_unclosed_string(std::string_view text, Span string) noexcept;
/// The end of the comment or string at `at`; `at` if there is none.
std::uint32_t end_of_opaque(std::string_view text, std::uint32_t at) noexcept;

}  // namespace sdlc::lang
