#include "lsp/session_scenes.hpp"

#include <algorithm>
#include <utility>

#include "lang/diagnostics/diagnostics.hpp"

namespace sdlc::lsp {

SessionScenes::SessionScenes(Session& session, const Text& text, const lang::SharedSymbol& symbol)
    : session_(session) {
  const std::filesystem::path own = text.view->root().name();
  const bool is_local = symbol.path.empty() || symbol.is_local_to_file;
  if (!is_local) scenes_ = session.scenes_with(session.workspace().identity(symbol.path));
  if (std::ranges::find(scenes_, own) == scenes_.end()) scenes_.insert(scenes_.begin(), own);
}

const lang::SceneView* SessionScenes::scene(std::size_t index) {
  lang::stop_if_requested(&session_.stop());
  return session_.view_of(scenes_[index]);
}

}  // namespace sdlc::lsp
