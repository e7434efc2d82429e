#pragma once

#include "lsp/json_rpc.hpp"
#include "lsp/session.hpp"

/// Requests that lead from a name to its declaration and its uses.
namespace sdlc::lsp {

/// textDocument/definition: the name of an import leads to its file.
Json go_to_definition(Session& session, const Json& params);
/// textDocument/declaration: the name of an import leads to the import.
Json go_to_declaration(Session& session, const Json& params);
/// textDocument/references: in all scenes that read the file of the declaration.
Json find_references(Session& session, const Json& params);
/// textDocument/documentHighlight.
Json highlight(Session& session, const Json& params);
/// textDocument/documentLink: the paths of imports and includes, if their files exist.
Json list_links(Session& session, const Json& params);

}  // namespace sdlc::lsp
