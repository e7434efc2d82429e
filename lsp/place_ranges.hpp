#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "lang/editor/navigation.hpp"
#include "lang/source/position_encoding.hpp"
#include "lang/source/source.hpp"
#include "lang/workspace/document.hpp"
#include "lsp/json_rpc.hpp"
#include "lsp/session.hpp"

namespace sdlc::lsp {

/// Ranges of many spans of a text.
class TextRanges {
 public:
  /// `file` must outlive the ranges.
  TextRanges(const Session& session, const lang::SourceFile& file)
      : positions_(file, session.client().encoding()) {}

  Json position(std::uint32_t offset);
  Json range(lang::Span span);

 private:
  lang::PositionMap positions_;
};

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
