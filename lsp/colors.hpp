#pragma once

#include "lsp/json_rpc.hpp"
#include "lsp/session.hpp"

/// Colours of scenes and configs, for swatches and colour pickers.
namespace sdlc::lsp {

/// `textDocument/documentColor`
Json document_color(Session& session, const Json& params);
/// `textDocument/colorPresentation`
Json color_presentation(Session& session, const Json& params);

}  // namespace sdlc::lsp
