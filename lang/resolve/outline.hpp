#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "lang/resolve/symbol.hpp"
#include "lang/source/source.hpp"
#include "lang/syntax/syntax.hpp"

namespace sdlc::lang {

/// A declaration or an object of a file.
struct OutlineItem {
  SymbolKind kind = SymbolKind::Let;
  std::string_view name;         ///< of an object without one: its kind
  std::string_view object_kind;  ///< of an object
  Span whole;                    ///< the statement
  Span where;                    ///< the name
  std::uint32_t depth = 0;       ///< number of items around it
};

/// The declarations and objects of a file in the order of the text, nested as groups and defs are.
/// Loops and conditions add no level.
std::vector<OutlineItem> outline_of(const SyntaxTree& tree);

}  // namespace sdlc::lang
