#include "lsp/symbol_kinds.hpp"

namespace sdlc::lsp {
namespace {

ProtocolSymbol symbol_of(lang::SymbolIcon icon) {
  switch (icon) {
    case lang::SymbolIcon::Let: return ProtocolSymbol::Constant;
    case lang::SymbolIcon::Param: return ProtocolSymbol::Variable;
    case lang::SymbolIcon::Import: return ProtocolSymbol::Module;
    case lang::SymbolIcon::Function: return ProtocolSymbol::Function;
    case lang::SymbolIcon::Kind: return ProtocolSymbol::Class;
    case lang::SymbolIcon::Object: return ProtocolSymbol::Object;
    case lang::SymbolIcon::Array: return ProtocolSymbol::Array;
    case lang::SymbolIcon::Number: return ProtocolSymbol::Number;
    case lang::SymbolIcon::String: return ProtocolSymbol::String;
    case lang::SymbolIcon::Bool: return ProtocolSymbol::Boolean;
    case lang::SymbolIcon::Null: return ProtocolSymbol::Null;
  }
  return ProtocolSymbol::Constant;
}

}  // namespace

int symbol_number(lang::SymbolIcon icon, bool knows_all) {
  const ProtocolSymbol symbol = symbol_of(icon);
  const bool is_known = knows_all || symbol <= ProtocolSymbol::Array;
  return static_cast<int>(is_known ? symbol : ProtocolSymbol::Variable);
}

int symbol_number(lang::SymbolKind kind, bool knows_all) {
  return symbol_number(lang::icon_of(kind), knows_all);
}

}  // namespace sdlc::lsp
