#include "lang/token/brackets.hpp"

#include "lang/token/token_reader.hpp"

namespace sdlc::lang {

std::uint32_t end_of_bracket(std::string_view text, std::uint32_t at) noexcept {
  std::size_t depth = 0;
  TokenReader reader(text, at);
  for (Token token = reader.next(); token.kind != TokenKind::End; token = reader.next()) {
    if (token.kind == TokenKind::Open) ++depth;
    if (token.kind == TokenKind::Close && --depth == 0) return token.span.end;
  }
  return at;
}

}  // namespace sdlc::lang
