#include "lsp/session_scenes.hpp"

#include <algorithm>
#include <chrono>
#include <thread>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/source/source.hpp"

namespace sdlc::lsp {

namespace fs = std::filesystem;

bool wait_for_index(const Session& session) {
  const auto deadline = std::chrono::steady_clock::now() + session.server_options().patience;
  while (!session.index().is_complete()) {
    if (std::chrono::steady_clock::now() > deadline) return false;
    lang::stop_if_requested(&session.stop());
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return true;
}

SessionScenes::SessionScenes(Session& session, const Text& text, const lang::SharedSymbol& symbol)
    : session_(session), scenes_{text.view->root().name()} {
  if (symbol.path.empty() || symbol.is_local_to_file) return;
  const auto add = [&](const fs::path& scene) {
    if (std::ranges::find(scenes_, scene) == scenes_.end()) scenes_.push_back(scene);
  };
  is_complete_ = wait_for_index(session);
  for (const fs::path& scene : session.scenes_with(session.workspace().identity(symbol.path))) {
    add(scene);
  }
  // What has just been typed is not in the index yet.
  for (const auto& [uri, file] : session.open_files()) {
    if (lang::source_format_of(file.path, *file.text) == lang::SourceFormat::Scene) {
      add(file.identity);
    }
  }
}

const lang::SceneView* SessionScenes::scene(std::size_t index) {
  lang::stop_if_requested(&session_.stop());
  return session_.view_of(scenes_[index]);
}

}  // namespace sdlc::lsp
