#include "lsp/rename.hpp"

#include <cstdint>
#include <map>
#include <string>
#include <utility>

#include "lang/editor/navigation.hpp"
#include "lang/editor/rename.hpp"
#include "lsp/edits_json.hpp"
#include "lsp/place_ranges.hpp"
#include "lsp/session_scenes.hpp"

namespace sdlc::lsp {
namespace {

[[noreturn]] void refuse(const std::string& reason) {
  throw RequestError(ErrorCode::RequestFailed, reason);
}

Text scene_text(Session& session, const Json& params) {
  Text text = session.text_of(params);
  if (!text.is_scene()) refuse("A JSON config has no names that could be changed.");
  return text;
}

}  // namespace

Json prepare_rename(Session& session, const Json& params) {
  const Text text = scene_text(session, params);
  const std::uint32_t offset = session.offset(text, params.at("position"));
  const lang::RenameTarget target = lang::prepare_rename(*text.view, text.file, offset);
  if (!target.refusal.empty()) refuse(target.refusal);
  return {{"range", session.range(*text.source, target.where)},
          {"placeholder", text.source->text(target.where)}};
}

Json rename(Session& session, const Json& params) {
  const Text text = scene_text(session, params);
  const std::uint32_t offset = session.offset(text, params.at("position"));
  const auto new_name = params.at("newName").get<std::string>();
  const lang::RenameTarget target = lang::prepare_rename(*text.view, text.file, offset);
  if (!target.refusal.empty()) refuse(target.refusal);
  const auto symbol = lang::shared_symbol(*text.view, text.file, offset);
  SessionScenes scenes(session, text, *symbol);
  if (!scenes.is_complete()) refuse("The folder has not been read yet: try again in a moment.");
  const lang::RenamePlan plan =
      lang::plan_rename(scenes, *symbol, new_name, {.folders = session.folders()});
  if (!plan.refusal.empty()) refuse(plan.refusal);

  std::map<std::string, Json> edits;
  PlaceRanges ranges(session);
  for (const lang::Place& place : plan.places) {
    Json range = ranges.range(place);
    if (range.is_null()) refuse("`" + place.path.string() + "` cannot be read.");
    auto& list = edits.try_emplace(session.uri_of(place.path), Json::array()).first->second;
    list.push_back({{"range", std::move(range)}, {"newText", new_name}});
  }
  return workspace_edit(session, edits);
}

}  // namespace sdlc::lsp
