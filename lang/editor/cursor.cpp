#include "lang/editor/cursor.hpp"

#include <algorithm>
#include <string_view>

#include "lang/token/token_reader.hpp"

namespace sdlc::lang {
namespace {

/// The token that contains the byte at `offset`, which is before the first child of the node or
/// between two children. `begin`: a token's begin before it.
Token find_token(std::string_view text, std::uint32_t begin, std::uint32_t offset) {
  TokenReader tokens(text, begin);
  Token token = tokens.next();
  while (token.kind != TokenKind::End && token.span.end <= offset) token = tokens.next();
  return token;
}

bool is_word(TokenKind kind) {
  return is_name(kind) || is_string(kind) || kind == TokenKind::Number || kind == TokenKind::Color;
}

}  // namespace

Cursor cursor_on(const SyntaxTree& tree, std::uint32_t offset) {
  Cursor cursor;
  cursor.nodes.emplace_back(tree, 0);
  std::uint32_t begin = 0;
  for (bool is_inside = true; is_inside;) {
    is_inside = false;
    for (const ast::Node child : cursor.nodes.back().children()) {
      if (child.span().begin > offset) break;
      begin = child.span().end;
      if (offset >= child.span().end) continue;
      begin = child.span().begin;
      cursor.nodes.push_back(child);
      is_inside = true;
      break;
    }
  }
  cursor.token = find_token(tree.file().text(), begin, offset);
  return cursor;
}

Cursor cursor_at(const SyntaxTree& tree, std::uint32_t offset) {
  const auto size = static_cast<std::uint32_t>(tree.file().text().size());
  offset = std::min(offset, size);
  Cursor cursor = cursor_on(tree, offset);
  if (offset == 0 || is_word(cursor.token.kind)) return cursor;
  if (cursor.token.span.begin < offset) return cursor;
  Cursor before = cursor_on(tree, offset - 1);
  return is_word(before.token.kind) ? before : cursor;
}

bool has_colon_after(std::string_view text, std::uint32_t end) noexcept {
  return text.substr(skip_space(text, end), 1) == ":";
}

}  // namespace sdlc::lang
