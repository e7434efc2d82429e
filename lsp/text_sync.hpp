#pragma once

#include "lsp/session.hpp"

/// Texts that the client opens, changes and closes, and files that change on disk.
namespace sdlc::lsp {

void did_open(Session& session, const Json& params);
void did_change(Session& session, const Json& params);
void did_close(Session& session, const Json& params);
void did_save(Session& session, const Json& params);
void did_change_watched_files(Session& session, const Json& params);

}  // namespace sdlc::lsp
