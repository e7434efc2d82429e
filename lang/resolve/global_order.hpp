#pragma once

#include <cstdint>
#include <vector>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/resolve/module.hpp"

namespace sdlc::lang {

/// The names that one declaration uses of its own file, and whether it may read `time`.
struct Uses {
  std::vector<std::uint32_t> globals, functions;
  bool time = false;  ///< itself, or through another file

  void clear() noexcept {
    globals.clear();
    functions.clear();
    time = false;
  }
};

/// Sorts the globals of a file topologically into Module::order, since their order in the text does
/// not matter, and sets `uses_time` of globals and functions. A global that depends on
/// itself is reported and omitted.
void order_globals(Module& module, const std::vector<Uses>& of_globals,
                   const std::vector<Uses>& of_functions, DiagnosticSink& sink);

}  // namespace sdlc::lang
