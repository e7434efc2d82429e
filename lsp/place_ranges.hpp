#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "lang/editor/navigation.hpp"
#include "lang/workspace/document.hpp"
#include "lsp/json_rpc.hpp"
#include "lsp/positions.hpp"
#include "lsp/session.hpp"

namespace sdlc::lsp {

/// Ranges of places, which are best sorted by path: a text is loaded when the path changes.
class PlaceRanges {
 public:
  explicit PlaceRanges(Session& session) : session_(session) {}

  /// Null if the file cannot be read.
  Json range(const lang::Place& place);

 private:
  Session& session_;
  std::filesystem::path path_;
  std::shared_ptr<const lang::Document> document_;
  std::optional<TextRanges> ranges_;
};

}  // namespace sdlc::lsp
