#pragma once

#include "lsp/json_rpc.hpp"
#include "lsp/session.hpp"

/// Ranges that an editor folds or selects.
namespace sdlc::lsp {

/// textDocument/foldingRange.
Json list_folding_ranges(Session& session, const Json& params);
/// textDocument/selectionRange.
Json list_selection_ranges(Session& session, const Json& params);

}  // namespace sdlc::lsp
