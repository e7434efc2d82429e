#pragma once

#include "lsp/json_rpc.hpp"
#include "lsp/session.hpp"

/// Outlines of files, and the search for symbols in all files.
namespace sdlc::lsp {

/// textDocument/documentSymbol: nested if the client can show that, else a list.
Json list_document_symbols(Session& session, const Json& params);
/// workspace/symbol: declarations and named objects of all scenes in the folders.
Json find_workspace_symbols(Session& session, const Json& params);

}  // namespace sdlc::lsp
