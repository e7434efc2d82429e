#include "lang/resolve/path.hpp"

#include "lang/token/token_reader.hpp"

namespace sdlc::lang {

std::vector<std::string_view> split_path(std::string_view path) {
  std::vector<std::string_view> names;
  TokenReader tokens(path);
  for (Token token = tokens.next(); token.kind != TokenKind::End; token = tokens.next()) {
    if (is_name(token.kind)) names.push_back(tokens.text(token));
  }
  return names;
}

}  // namespace sdlc::lang
