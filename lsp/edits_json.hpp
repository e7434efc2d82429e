#pragma once

#include <map>
#include <span>
#include <string>

#include "lang/editor/text_edits.hpp"
#include "lang/source/source.hpp"
#include "lsp/session.hpp"

/// Edits as the protocol writes them.
namespace sdlc::lsp {

/// `TextEdit[]`
Json edits_json(const Session& session, const lang::SourceFile& file,
                std::span<const lang::TextEdit> edits);

/// A `WorkspaceEdit` of edits by URI, with the versions of open texts if the client can check them.
Json workspace_edit(const Session& session, const std::map<std::string, Json>& edits);

}  // namespace sdlc::lsp
