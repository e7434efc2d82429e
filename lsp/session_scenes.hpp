#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "lang/editor/navigation.hpp"
#include "lsp/session.hpp"

namespace sdlc::lsp {

/// Whether the folders have been read, after some patience. Throws lang::StopRequested if the
/// request was cancelled.
bool wait_for_index(const Session& session);

/// The scenes that can use a symbol, resolved one after the other.
class SessionScenes final : public lang::SceneSet {
 public:
  /// `text`: where the symbol was found. Its scene alone, for a symbol that no other file can use.
  /// For any other, waits a moment until the folders have been read.
  SessionScenes(Session& session, const Text& text, const lang::SharedSymbol& symbol);

  /// Whether the folders have been read: there may be other scenes otherwise.
  bool is_complete() const noexcept { return is_complete_; }

  std::size_t size() const override { return scenes_.size(); }
  /// Throws lang::StopRequested if the request was cancelled.
  const lang::SceneView* scene(std::size_t index) override;

 private:
  Session& session_;
  bool is_complete_ = true;
  std::vector<std::filesystem::path> scenes_;
};

}  // namespace sdlc::lsp
