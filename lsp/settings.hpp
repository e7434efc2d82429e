#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "lang/source/limits.hpp"
#include "lsp/json_rpc.hpp"
#include "lsp/log.hpp"

namespace sdlc::lsp {

/// What the command line says.
struct ServerOptions {
  lang::Limits limits;
  bool is_sandboxed = false;               ///< a client cannot turn it off
  std::string version = {};                ///< of sdlc
  std::string program = "/proc/self/exe";  ///< renders: `sdlc` itself
  bool has_threads = true;                 ///< otherwise Server::receive() does all work
  /// How long a request waits for findings or for the folders to be read. Then it is answered
  /// without them.
  std::chrono::milliseconds patience{5000};
};

/// The section `sdlc` of the editor's settings. A missing or wrong value is the default.
struct Settings {
  int threads = 0;            ///< of renders; 0: all
  bool is_sandboxed = false;  ///< `sandbox`: scenes read no files outside their folder
  bool inlay_hints = false;   ///< `inlayHints`
  Trace trace = Trace::Off;   ///< `trace.server`: off, messages, verbose

  /// Adds a sentence for each wrong setting.
  static Settings of(const Json& json, std::vector<std::string>& mistakes);
};

}  // namespace sdlc::lsp
