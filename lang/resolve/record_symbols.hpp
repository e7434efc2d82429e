#pragma once

#include <cstdint>

#include "lang/resolve/module.hpp"
#include "lang/resolve/symbol_table.hpp"

namespace sdlc::lang {

/// The symbols of a file whose declarations have been collected. All statements and bodies are
/// resolved without evaluation; unreadable text is omitted. Reports nothing and loads no file.
SymbolTable record_symbols(Modules& modules, std::uint32_t module, SymbolDetail detail);

}  // namespace sdlc::lang
