#pragma once

#include "lang/resolve/symbol_index.hpp"
#include "lang/value/types.hpp"

namespace sdlc::lang {

/// The type of the values that a symbol has, as far as the text says it without being run: the
/// declared one, or that of the expression. Null: not known.
const TypeInfo* type_of(const SymbolIndex& index, SymbolId symbol);

}  // namespace sdlc::lang
