#pragma once

#include "lsp/session.hpp"

/// Code actions: the fixes of findings, comments that allow them, and all safe fixes of a text.
namespace sdlc::lsp {

Json list_code_actions(Session& session, const Json& params);
/// Computes the edit of "fix all", for clients that ask for it later.
Json resolve_code_action(Session& session, const Json& params);

/// `CodeActionOptions`
Json code_action_options();

/// The edit of all safe fixes of the text that `params.textDocument` names; null if there is none.
Json fix_all_edit(Session& session, const Json& params);

}  // namespace sdlc::lsp
