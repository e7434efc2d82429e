#include "lsp/navigation.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lang/editor/links.hpp"
#include "lang/editor/navigation.hpp"
#include "lang/source/position_encoding.hpp"
#include "lsp/place_ranges.hpp"
#include "lsp/positions.hpp"
#include "lsp/session_scenes.hpp"

namespace sdlc::lsp {
namespace {

/// A LocationLink if the client knows them, else a Location.
Json target_json(Session& session, const Text& text, const lang::JumpTarget& target,
                 const std::string& capability) {
  Json whole = first_range(), name = first_range();
  if (const auto file = text.view->find(target.path)) {
    const lang::SourceFile& source = text.view->file(*file);
    whole = session.range(source, target.whole);
    name = session.range(source, target.where);
  } else if (!session.load(target.path)) {
    return nullptr;  // the path of an import leads nowhere
  }
  const std::string uri = session.uri_of(target.path);
  if (!session.client().can(capability)) return {{"uri", uri}, {"range", std::move(name)}};
  return Json::array({{{"originSelectionRange", session.range(*text.source, target.origin)},
                       {"targetUri", uri},
                       {"targetRange", std::move(whole)},
                       {"targetSelectionRange", std::move(name)}}});
}

}  // namespace

Json go_to_definition(Session& session, const Json& params) {
  const Text text = session.text_of(params);
  if (!text.is_scene()) return nullptr;
  const std::uint32_t offset = session.offset(text, params.at("position"));
  const auto target = lang::definition(*text.view, text.file, offset);
  if (!target) return nullptr;
  return target_json(session, text, *target, "/textDocument/definition/linkSupport");
}

Json go_to_declaration(Session& session, const Json& params) {
  const Text text = session.text_of(params);
  if (!text.is_scene()) return nullptr;
  const std::uint32_t offset = session.offset(text, params.at("position"));
  const auto target = lang::declaration(*text.view, text.file, offset);
  if (!target) return nullptr;
  return target_json(session, text, *target, "/textDocument/declaration/linkSupport");
}

Json find_references(Session& session, const Json& params) {
  const Text text = session.text_of(params);
  if (!text.is_scene()) return Json::array();
  const std::uint32_t offset = session.offset(text, params.at("position"));
  const auto symbol = lang::shared_symbol(*text.view, text.file, offset);
  if (!symbol) return Json::array();
  const Json context = params.value("context", Json::object());
  SessionScenes scenes(session, text, *symbol);
  Json locations = Json::array();
  PlaceRanges ranges(session);
  for (const lang::Place& place :
       lang::references(scenes, *symbol, context.value("includeDeclaration", true))) {
    Json range = ranges.range(place);
    if (range.is_null()) continue;
    locations.push_back({{"uri", session.uri_of(place.path)}, {"range", std::move(range)}});
  }
  return locations;
}

Json highlight(Session& session, const Json& params) {
  const Text text = session.text_of(params);
  if (!text.is_scene()) return Json::array();
  const std::uint32_t offset = session.offset(text, params.at("position"));
  constexpr int kRead = 2, kWrite = 3;  // DocumentHighlightKind
  TextRanges ranges(*text.source, session.client().encoding());
  Json found = Json::array();
  for (const lang::Highlight& name : lang::highlights(*text.view, text.file, offset)) {
    found.push_back(
        {{"range", ranges.range(name.where)}, {"kind", name.is_write ? kWrite : kRead}});
  }
  return found;
}

Json list_links(Session& session, const Json& params) {
  const Text text = session.text_of(params);
  Json links = Json::array();
  if (!text.is_scene()) return links;
  TextRanges ranges(*text.source, session.client().encoding());
  const lang::Module& module = text.view->module(text.file);
  for (const lang::FileLink& link :
       lang::file_links(module.tree, module.path, session.workspace())) {
    if (!link.exists) continue;
    links.push_back({{"range", ranges.range(link.where)}, {"target", session.uri_of(link.target)}});
  }
  return links;
}

}  // namespace sdlc::lsp
