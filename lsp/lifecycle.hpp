#pragma once

#include "lsp/session.hpp"

/// The beginning and end of a session, and its settings.
namespace sdlc::lsp {

Json initialize(Session& session, const Json& params);
void initialized(Session& session, const Json& params);
Json shut_down(Session& session, const Json& params);
void set_trace(Session& session, const Json& params);
void did_change_configuration(Session& session, const Json& params);
void did_change_workspace_folders(Session& session, const Json& params);

}  // namespace sdlc::lsp
