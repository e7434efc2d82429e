#pragma once

#include "lsp/json_rpc.hpp"
#include "lsp/session.hpp"

/// The call hierarchy of functions and kinds.
namespace sdlc::lsp {

/// textDocument/prepareCallHierarchy.
Json prepare_call_hierarchy(Session& session, const Json& params);
/// callHierarchy/incomingCalls.
Json list_incoming_calls(Session& session, const Json& params);
/// callHierarchy/outgoingCalls.
Json list_outgoing_calls(Session& session, const Json& params);

}  // namespace sdlc::lsp
