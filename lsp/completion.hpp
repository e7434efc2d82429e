#pragma once

#include "lsp/session.hpp"

/// Completion and signature help.
namespace sdlc::lsp {

/// textDocument/completion
Json completion(Session& session, const Json& params);
/// completionItem/resolve: adds the page about a diagnostic.
Json resolve_completion(Session& session, const Json& item);
/// textDocument/signatureHelp
Json signature_help(Session& session, const Json& params);

Json completion_options();
Json signature_help_options();

}  // namespace sdlc::lsp
