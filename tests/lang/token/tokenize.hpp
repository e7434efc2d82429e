#pragma once

#include <string_view>
#include <vector>

#include "lang/token/token_reader.hpp"

namespace sdlc::test {

/// All tokens of a text, without End.
inline std::vector<lang::Token> tokenize(std::string_view text,
                                         lang::SourceFormat format = lang::SourceFormat::Scene) {
  using lang::Token, lang::TokenKind;
  std::vector<Token> tokens;
  lang::TokenReader reader(text, 0, format);
  for (Token token = reader.next(); token.kind != TokenKind::End; token = reader.next()) {
    tokens.push_back(token);
  }
  return tokens;
}

}  // namespace sdlc::test
