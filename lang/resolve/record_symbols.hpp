#pragma once

#include <cstdint>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/resolve/module.hpp"
#include "lang/resolve/symbol_table.hpp"

namespace sdlc::lang {

/// The symbols of a file whose declarations have been collected. All statements and bodies are
/// resolved without evaluation; unreadable text is omitted. Reports nothing and loads no file.
/// `stop` may be null.
SymbolTable record_symbols(Modules& modules, std::uint32_t module, SymbolDetail detail,
                           const StopRequest* stop);

}  // namespace sdlc::lang
