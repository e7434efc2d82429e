#include "lang/token/token_reader.hpp"

namespace sdlc::lang {

std::vector<Token> tokenize(std::string_view text, SourceFormat format) {
  std::vector<Token> tokens;
  TokenReader reader(text, 0, format);
  for (Token token = reader.next(); token.kind != TokenKind::End; token = reader.next()) {
    tokens.push_back(token);
  }
  return tokens;
}

std::uint32_t skip_space(std::string_view text, std::uint32_t at) noexcept {
  return TokenReader(text, at).next_solid().span.begin;
}

Span token_at(std::string_view text, std::uint32_t at) noexcept {
  return scene_token(text, at).span;
}

std::uint32_t end_of_unclosed_string(std::string_view text, Span string) noexcept {
  const std::size_t last = text.find_last_not_of(" \t\r)]},", string.end - 1);
  return static_cast<std::uint32_t>(last + 1);
}

std::uint32_t end_of_opaque(std::string_view text, std::uint32_t at) noexcept {
  // Whoever asks at every byte should not read a token at each.
  if (at >= text.size() || (text[at] != '"' && text[at] != '/')) return at;
  const Token token = scene_token(text, at);
  return is_comment(token.kind) || is_string(token.kind) ? token.span.end : at;
}

}  // namespace sdlc::lang
