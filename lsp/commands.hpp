#pragma once

#include "lsp/session.hpp"

/// Commands, which take one argument:
///
/// * `sdlc.render` {uri, camera?, frame?} renders the scene as it is in the editor, and shows the
///   picture. A file without a camera is rendered with the scene that it is checked in.
/// * `sdlc.preview` {uri, external?} shows the scene, as it is in the editor, on a page that
/// follows
///   its changes; returns {url, scene}. With `external` the editor is asked to open it in a
///   browser.
/// * `sdlc.fixAll` {uri} applies all safe fixes.
/// * `sdlc.explain` {code} returns the page about a code as {code, markdown}.
/// * `sdlc.chooseScene` {uri, scene?} chooses the scene that a file is checked in, null for the
///   automatic choice; without `scene` it asks the user.
namespace sdlc::lsp {

Json execute_command(Session& session, const Json& params);
/// `sdlc/cursor` {textDocument, position}: the cursor has moved. Pages of `sdlc.preview` outline
/// what the statement there makes.
void cursor_moved(Session& session, const Json& params);
/// `window/workDoneProgress/cancel`
void cancel_progress(Session& session, const Json& params);

/// The names of the commands.
Json command_names();

}  // namespace sdlc::lsp
