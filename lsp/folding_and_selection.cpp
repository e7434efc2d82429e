#include "lsp/folding_and_selection.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <string_view>
#include <vector>

#include "lang/editor/folding.hpp"
#include "lang/editor/selection_ranges.hpp"
#include "lang/source/position_encoding.hpp"
#include "lang/syntax/syntax.hpp"
#include "lang/token/lines.hpp"
#include "lsp/positions.hpp"

namespace sdlc::lsp {
namespace {

/// Ranges that are sent at most: the maximum of VS Code.
constexpr std::size_t kMaxFoldingRanges = 5000;

const lang::SyntaxTree* tree_of(const Text& text) {
  return text.is_scene() ? &text.view->tree(text.file) : nullptr;
}

/// The kind in the protocol; null for brackets, which have none.
const char* kind_of(const lang::FoldingRange& range) {
  switch (range.kind) {
    case lang::FoldingKind::Brackets: return nullptr;
    case lang::FoldingKind::Comment: return "comment";
    case lang::FoldingKind::Imports: return "imports";
  }
  return nullptr;
}

Json folding_json(const lang::FoldingRange& range, lang::Position begin, lang::Position end) {
  Json json{{"startLine", begin.line - 1}, {"endLine", end.line - 1}};
  if (const char* kind = kind_of(range)) json["kind"] = kind;
  return json;
}

/// Ranges of whole lines. The line of a closing bracket remains visible if it begins with it. Of
/// ranges that begin in one line, an editor shows one: the largest.
Json folded_lines(const std::vector<lang::FoldingRange>& ranges, const Text& text,
                  lang::PositionMap& positions) {
  std::map<std::uint32_t, Json> by_line;
  for (const lang::FoldingRange& range : ranges) {
    const lang::Position begin = positions.at(range.hidden.begin);
    lang::Position end = positions.at(range.hidden.end);
    const bool is_closing_line = range.kind == lang::FoldingKind::Brackets &&
                                 lang::is_first_of_line(text.source->text(), range.hidden.end);
    if (is_closing_line) --end.line;
    if (end.line <= begin.line) continue;
    Json json = folding_json(range, begin, end);
    Json& known = by_line[begin.line];
    if (known.is_null() || known.at("endLine") < json.at("endLine")) known = std::move(json);
  }
  Json list = Json::array();
  for (auto& [line, json] : by_line) list.push_back(std::move(json));
  return list;
}

Json folded_text(const std::vector<lang::FoldingRange>& ranges, lang::PositionMap& positions) {
  Json list = Json::array();
  for (const lang::FoldingRange& range : ranges) {
    const lang::Position begin = positions.at(range.hidden.begin);
    const lang::Position end = positions.at(range.hidden.end);
    Json json = folding_json(range, begin, end);
    json["startCharacter"] = begin.column - 1;
    json["endCharacter"] = end.column - 1;
    list.push_back(std::move(json));
  }
  return list;
}

}  // namespace

Json list_folding_ranges(Session& session, const Json& params) {
  const Text text = session.text_of(params);
  const auto ranges = lang::folding_ranges(*text.source, tree_of(text), kMaxFoldingRanges);
  lang::PositionMap positions(*text.source, session.client().encoding());
  const bool has_lines_only = session.client().can("/textDocument/foldingRange/lineFoldingOnly");
  return has_lines_only ? folded_lines(ranges, text, positions) : folded_text(ranges, positions);
}

Json list_selection_ranges(Session& session, const Json& params) {
  const Text text = session.text_of(params);
  std::vector<std::uint32_t> offsets;
  for (const Json& position : params.at("positions")) {
    offsets.push_back(session.offset(text, position));
  }
  TextRanges ranges(*text.source, session.client().encoding());
  Json all = Json::array();
  for (const auto& chain : lang::selection_ranges(*text.source, tree_of(text), offsets)) {
    Json selection;
    for (auto span = chain.rbegin(); span != chain.rend(); ++span) {
      Json inner{{"range", ranges.range(*span)}};
      if (!selection.is_null()) inner["parent"] = std::move(selection);
      selection = std::move(inner);
    }
    // Every position has an answer, also in an empty text.
    if (selection.is_null()) selection = {{"range", ranges.range({0, 0})}};
    all.push_back(std::move(selection));
  }
  return all;
}

}  // namespace sdlc::lsp
