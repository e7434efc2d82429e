#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "lang/source/source.hpp"
#include "lang/token/token.hpp"

namespace sdlc::lang {

/// The kind of each byte that is a whole token in both formats; End for all others.
inline constexpr std::array<TokenKind, 256> kOneByteTokens = [] {
  std::array<TokenKind, 256> kinds{};
  kinds.fill(TokenKind::End);
  for (const unsigned char c : {'(', '[', '{'}) kinds[c] = TokenKind::Open;
  for (const unsigned char c : {')', ']', '}'}) kinds[c] = TokenKind::Close;
  for (const unsigned char c : {',', ':'}) kinds[c] = TokenKind::Mark;
  kinds['\n'] = TokenKind::LineEnd;
  return kinds;
}();

/// The kind of the token at `at`, which is moved to the token's end. Precondition: `at` is in the
/// text, and the token is none of kOneByteTokens.
TokenKind take_scene_token(std::string_view text, std::uint32_t& at) noexcept;
TokenKind take_json_token(std::string_view text, std::uint32_t& at) noexcept;

/// Reads tokens one by one and stores none, so that the size of the text does not matter. A copy
/// looks ahead.
class TokenReader {
 public:
  /// Begins with the token at `at`, which must not be within a comment or string.
  explicit TokenReader(std::string_view text, std::uint32_t at = 0,
                       SourceFormat format = SourceFormat::Scene) noexcept
      : text_(text), at_(at), format_(format) {}

  /// The next token, trivia included; at the end of the text End. Any text has tokens; one after
  /// the other, they are the whole text.
  Token next() noexcept {
    const std::uint32_t begin = at_;
    if (begin >= text_.size()) return {{begin, begin}, TokenKind::End};
    // More than half of all tokens end here.
    TokenKind kind = kOneByteTokens[static_cast<unsigned char>(text_[begin])];
    if (kind != TokenKind::End) {
      ++at_;
    } else if (format_ == SourceFormat::Scene) {
      kind = take_scene_token(text_, at_);
    } else {
      kind = take_json_token(text_, at_);
    }
    return {{begin, at_}, kind};
  }
  /// The next token that is not Space: a line end or a comment is not skipped.
  Token next_in_line() noexcept {
    // Most spaces need no call.
    while (at_ < text_.size() && text_[at_] == ' ') ++at_;
    Token token = next();
    while (token.kind == TokenKind::Space) token = next();
    return token;
  }
  /// The next token that is no trivia.
  Token next_solid() noexcept {
    Token token = next_in_line();
    while (is_trivia(token.kind)) token = next_in_line();
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

inline Token scene_token(std::string_view text, std::uint32_t at) noexcept {
  return TokenReader(text, at).next();
}

/// Where the first token begins from `at` on that is no trivia.
std::uint32_t skip_space(std::string_view text, std::uint32_t at) noexcept;
/// The token of a scene at `at`; empty at the end of the text.
Span token_at(std::string_view text, std::uint32_t at) noexcept;
/// Where an unclosed string was probably meant to end: before the brackets and commas at the end of
/// its line.
std::uint32_t end_of_unclosed_string(std::string_view text, Span string) noexcept;

}  // namespace sdlc::lang
