#pragma once

#include "lang/resolve/symbol_index.hpp"
#include "lang/value/types.hpp"

namespace sdlc::lang {

/// The static type of a symbol: the declared one, or that inferred from its expression. Null: not
/// known.
const TypeInfo* type_of(const SymbolIndex& index, SymbolId symbol);

}  // namespace sdlc::lang
