#pragma once

#include <cstdint>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/resolve/module.hpp"
#include "lang/resolve/symbol_table.hpp"

namespace sdlc::lang {

/// The names of a file whose declarations have been collected. Bodies of functions and defs and all
/// statements are resolved without being run, what cannot be read is left out; nothing is reported
/// and no file is loaded. `stop` may be null.
SymbolTable record_symbols(Modules& modules, std::uint32_t module, SymbolDetail detail,
                           const StopRequest* stop);

}  // namespace sdlc::lang
