#pragma once

#include "lsp/json_rpc.hpp"
#include "lsp/session.hpp"

namespace sdlc::lsp {

/// `textDocument/inlayHint`. No hints unless the settings want them.
Json inlay_hint(Session& session, const Json& params);
/// Asks the client to ask for the hints again, after a change of the settings.
void refresh_inlay_hints(Session& session);

}  // namespace sdlc::lsp
