#include "lsp/edits_json.hpp"

#include "lsp/positions.hpp"

namespace sdlc::lsp {

Json edits_json(const Session& session, const lang::SourceFile& file,
                std::span<const lang::TextEdit> edits) {
  TextRanges ranges(file, session.client().encoding());
  Json list = Json::array();
  for (const lang::TextEdit& edit : edits) {
    list.push_back({{"range", ranges.range(edit.where)}, {"newText", edit.text}});
  }
  return list;
}

Json workspace_edit(const Session& session, const std::map<std::string, Json>& edits) {
  if (!session.client().can("/workspace/workspaceEdit/documentChanges")) {
    return {{"changes", edits}};
  }
  Json changes = Json::array();
  for (const auto& [uri, list] : edits) {
    const OpenFile* open = session.find_open(uri);
    const Json version = open == nullptr ? Json() : Json(open->version);
    changes.push_back({{"textDocument", {{"uri", uri}, {"version", version}}}, {"edits", list}});
  }
  return {{"documentChanges", std::move(changes)}};
}

}  // namespace sdlc::lsp
