#pragma once

#include "lsp/session.hpp"

/// Formatting of texts. The options of the client, such as `tabSize`, have no effect: there is one
/// layout. A text that cannot be formatted is refused with the reason, which clients show.
namespace sdlc::lsp {

Json format_document(Session& session, const Json& params);
Json format_lines(Session& session, const Json& params);
/// Never refused: the user has not asked for it.
Json format_while_typing(Session& session, const Json& params);

/// `DocumentOnTypeFormattingOptions`
Json typing_triggers();

}  // namespace sdlc::lsp
