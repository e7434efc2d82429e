#pragma once

#include <span>
#include <string_view>

#include "lang/resolve/symbol.hpp"
#include "lang/schema/schema.hpp"

namespace sdlc::lang {

/// A name of the language.
struct BuiltinSymbol {
  SymbolKind kind;
  std::string_view name;
  const Property* property = nullptr;  ///< of a Property or Word
  std::string_view doc = {};
};

/// All of them, by kind, property and name.
std::span<const BuiltinSymbol> builtin_symbols();
/// The symbol of that kind and name; `property`: of a Property or Word. An unknown one if there is
/// none.
SymbolId find_builtin_symbol(SymbolKind kind, std::string_view name,
                             const Property* property = nullptr);

}  // namespace sdlc::lang
