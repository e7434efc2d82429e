#pragma once

#include <functional>
#include <string>

#include "lang/diagnostics/diagnostics.hpp"
#include "lsp/json_rpc.hpp"
#include "lsp/positions.hpp"

namespace sdlc::lsp {

/// How diagnostics are written for this client.
struct DiagnosticsJson {
  FileRanges ranges;
  bool has_related = false;  ///< the client shows related places
  std::function<std::string(const lang::SourceFile&)> uri_of;

  /// A `Diagnostic` of the protocol. One without a place is at the beginning of the file.
  Json of(const lang::Diagnostic& diagnostic);

 private:
  Json related(const lang::Diagnostic& diagnostic);
};

}  // namespace sdlc::lsp
