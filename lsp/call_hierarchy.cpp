#include "lsp/call_hierarchy.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lang/editor/call_hierarchy.hpp"
#include "lang/editor/navigation.hpp"
#include "lsp/place_ranges.hpp"
#include "lsp/positions.hpp"
#include "lsp/session_scenes.hpp"
#include "lsp/symbol_kinds.hpp"

namespace sdlc::lsp {
namespace {

/// A CallHierarchyItem; null if its file cannot be read.
Json item_json(Session& session, PlaceRanges& ranges, const lang::CallItem& item) {
  Json whole = first_range(), name = first_range();
  if (!item.is_file) {
    whole = ranges.range({.path = item.path, .where = item.whole});
    name = ranges.range({.path = item.path, .where = item.where});
    if (whole.is_null() || name.is_null()) return nullptr;
  }
  const int kind = item.is_file ? static_cast<int>(ProtocolSymbol::File)
                                : symbol_number(item.kind, /*knows_all=*/true);
  return {{"name", item.name},
          {"kind", kind},
          {"detail", item.path.filename().string()},
          {"uri", session.uri_of(item.path)},
          {"range", std::move(whole)},
          {"selectionRange", std::move(name)},
          {"data", {{"isFile", item.is_file}}}};
}

/// What an item of the client is about.
struct Asked {
  Text text;
  lang::CallItem item;
  std::optional<lang::SharedSymbol> symbol;  ///< of a function or kind
};

/// nullopt if the text has changed and the item is gone.
std::optional<Asked> asked_in(Session& session, const Json& params) {
  const Json& item = params.at("item");
  const Text text = session.text_of({{"textDocument", {{"uri", item.at("uri")}}}});
  if (!text.is_scene()) return std::nullopt;
  if (item.value("data", Json::object()).value("isFile", false)) {
    const std::filesystem::path& path = text.view->module(text.file).path;
    return Asked{.text = text,
                 .item = {.is_file = true, .name = {}, .path = path, .whole = {}, .where = {}},
                 .symbol = {}};
  }
  const std::uint32_t offset = session.offset(text, item.at("selectionRange").at("start"));
  auto found = lang::call_item_at(*text.view, text.file, offset);
  if (!found) return std::nullopt;
  return Asked{.text = text,
               .item = *std::move(found),
               .symbol = lang::shared_symbol(*text.view, text.file, offset)};
}

Json ranges_json(PlaceRanges& ranges, const std::filesystem::path& path,
                 const std::vector<lang::Span>& places) {
  Json list = Json::array();
  for (const lang::Span place : places) {
    Json range = ranges.range({.path = path, .where = place});
    if (!range.is_null()) list.push_back(std::move(range));
  }
  return list;
}

}  // namespace

Json prepare_call_hierarchy(Session& session, const Json& params) {
  const Text text = session.text_of(params);
  if (!text.is_scene()) return nullptr;
  const std::uint32_t offset = session.offset(text, params.at("position"));
  const auto item = lang::call_item_at(*text.view, text.file, offset);
  if (!item) return nullptr;
  PlaceRanges ranges(session);
  return Json::array({item_json(session, ranges, *item)});
}

Json list_incoming_calls(Session& session, const Json& params) {
  Json calls = Json::array();
  const auto asked = asked_in(session, params);
  if (!asked || !asked->symbol) return calls;
  SessionScenes scenes(session, asked->text, *asked->symbol);
  PlaceRanges ranges(session);
  for (const lang::CallGroup& group : lang::incoming_calls(scenes, *asked->symbol)) {
    Json from = item_json(session, ranges, group.item);
    if (from.is_null()) continue;
    calls.push_back({{"from", std::move(from)},
                     {"fromRanges", ranges_json(ranges, group.item.path, group.places)}});
  }
  return calls;
}

Json list_outgoing_calls(Session& session, const Json& params) {
  Json calls = Json::array();
  const auto asked = asked_in(session, params);
  if (!asked) return calls;
  PlaceRanges from(session), ranges(session);
  for (const lang::CallGroup& group : lang::outgoing_calls(*asked->text.view, asked->item)) {
    Json to = item_json(session, ranges, group.item);
    if (to.is_null()) continue;
    calls.push_back(
        {{"to", std::move(to)}, {"fromRanges", ranges_json(from, asked->item.path, group.places)}});
  }
  return calls;
}

}  // namespace sdlc::lsp
