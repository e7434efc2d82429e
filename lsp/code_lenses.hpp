#pragma once

#include "lsp/json_rpc.hpp"
#include "lsp/session.hpp"

namespace sdlc::lsp {

/// `textDocument/codeLens`: "Render", the command `sdlc.render` with `{uri, camera}`; without
/// `camera` if the scene needs no choice.
Json code_lens(Session& session, const Json& params);

}  // namespace sdlc::lsp
