#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "lang/editor/navigation.hpp"
#include "lsp/session.hpp"

namespace sdlc::lsp {

/// The scenes that can use a symbol, resolved one after the other.
class SessionScenes final : public lang::SceneSet {
 public:
  /// `text`: where the symbol was found. Its scene alone, for a symbol that no other file can use.
  SessionScenes(Session& session, const Text& text, const lang::SharedSymbol& symbol);

  std::size_t size() const override { return scenes_.size(); }
  /// Throws lang::StopRequested if the request was cancelled.
  const lang::SceneView* scene(std::size_t index) override;

 private:
  Session& session_;
  std::vector<std::filesystem::path> scenes_;
};

}  // namespace sdlc::lsp
