#pragma once

#include "lsp/json_rpc.hpp"
#include "lsp/session.hpp"

/// Renames over all files that use a name. A refusal is an error (RequestFailed) with its reason.
namespace sdlc::lsp {

/// textDocument/prepareRename.
Json prepare_rename(Session& session, const Json& params);
/// textDocument/rename.
Json rename(Session& session, const Json& params);

}  // namespace sdlc::lsp
