#pragma once

#include <span>
#include <string_view>

#include "lang/resolve/symbol.hpp"
#include "lang/schema/schema.hpp"

namespace sdlc::lang {

/// A symbol that the language defines.
struct BuiltinSymbol {
  SymbolKind kind;
  std::string_view name;
  const Property* property = nullptr;  ///< of a Property or Word
  std::string_view doc = {};
};

/// All of them, sorted by kind, property and name.
std::span<const BuiltinSymbol> builtin_symbols();
/// The symbol with this kind and name, and of a Property or Word with this property; an unknown one
/// if there is none.
SymbolId find_builtin_symbol(SymbolKind kind, std::string_view name,
                             const Property* property = nullptr);

}  // namespace sdlc::lang
