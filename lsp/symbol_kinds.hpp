#pragma once

#include "lang/editor/symbols.hpp"
#include "lang/resolve/symbol.hpp"
#include "lsp/client.hpp"

namespace sdlc::lsp {

/// SymbolKind of the protocol.
enum class ProtocolSymbol : int {
  File = 1,
  Module = 2,
  Class = 5,
  Function = 12,
  Variable = 13,
  Constant = 14,
  String = 15,
  Number = 16,
  Boolean = 17,
  Array = 18,
  Object = 19,
  Null = 21,
};

/// The number of the icon. Clients that do not list their kinds know only those up to Array.
int symbol_number(lang::SymbolIcon icon, bool knows_all);
/// Of a declaration or an object.
int symbol_number(lang::SymbolKind kind, bool knows_all);

}  // namespace sdlc::lsp
