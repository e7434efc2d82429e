#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "lang/ast/ast.hpp"
#include "lang/syntax/syntax.hpp"
#include "lang/token/token.hpp"

namespace sdlc::lang {

/// The place of an offset in a scene's text.
struct Cursor {
  Token token;                   ///< that contains the byte at the offset; End after the text
  std::vector<ast::Node> nodes;  ///< around the token, from the File to the innermost
};

/// The time does not depend on the size of the text, only on the number of siblings of the nodes.
Cursor cursor_on(const SyntaxTree& tree, std::uint32_t offset);
/// The same, but of a word, number or other literal that ends at the offset if none begins there.
Cursor cursor_at(const SyntaxTree& tree, std::uint32_t offset);

/// Whether a colon follows the word that ends at `end`: it is a label, or a parameter with a type.
bool has_colon_after(std::string_view text, std::uint32_t end) noexcept;

}  // namespace sdlc::lang
