#pragma once

#include <cstdint>
#include <vector>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/program/program.hpp"

namespace sdlc::lang {

/// What one declaration uses of its own file, and whether it may depend on the time.
struct Uses {
  std::vector<std::uint32_t> globals, functions;
  bool time = false;  ///< itself, or through another file
};

/// Orders the globals of a file so that each can be computed from those before it (ruling 9: the
/// order they are written in does not matter), and finds out which depend on the time. A value that
/// depends on itself is reported and left out.
void order_globals(Module& module, const std::vector<Uses>& of_globals,
                   const std::vector<Uses>& of_functions, DiagnosticSink& sink);

}  // namespace sdlc::lang
