#pragma once

#include <string_view>

#include "lang/resolve/symbol_index.hpp"
#include "lang/value/types.hpp"

namespace sdlc::lang {

/// The static type of a symbol: the declared one, or that inferred from its expression. Null: not
/// known.
const TypeInfo* type_of(const SymbolIndex& index, SymbolId symbol);

/// The type of the elements of a list that the `let` declares; null: not known.
const TypeInfo* element_type_of(const SymbolIndex& index, SymbolId list);
/// The type of the result of a built-in function; "=": that of its first argument; empty: it
/// varies, or there is no such function.
std::string_view result_of_builtin(std::string_view function);

}  // namespace sdlc::lang
