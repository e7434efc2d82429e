#pragma once

#include <cstdint>
#include <vector>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/resolve/module.hpp"

namespace sdlc::lang {

/// What one declaration uses of its own file, and whether it may read `time`.
struct Uses {
  std::vector<std::uint32_t> globals, functions;
  bool time = false;  ///< itself, or through another file

  void clear() noexcept {
    globals.clear();
    functions.clear();
    time = false;
  }
};

/// Orders the globals of a file so that each can be computed from those before it (ruling 9: the
/// order in the text does not matter), and finds those that may read `time`. A value that depends
/// on itself is reported and left out.
void order_globals(Module& module, const std::vector<Uses>& of_globals,
                   const std::vector<Uses>& of_functions, DiagnosticSink& sink);

}  // namespace sdlc::lang
