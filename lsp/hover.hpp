#pragma once

#include "lsp/json_rpc.hpp"
#include "lsp/session.hpp"

namespace sdlc::lsp {

/// `textDocument/hover`
Json hover(Session& session, const Json& params);

}  // namespace sdlc::lsp
