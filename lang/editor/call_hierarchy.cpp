#include "lang/editor/call_hierarchy.hpp"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

namespace sdlc::lang {

namespace fs = std::filesystem;

namespace {

bool is_callable(const Symbol& symbol) {
  return symbol.kind == SymbolKind::Fn || symbol.kind == SymbolKind::Def;
}

CallItem item_of(const SceneView& view, std::uint32_t file, const Symbol& symbol) {
  return {.kind = symbol.kind,
          .name = std::string(symbol.name),
          .path = view.module(file).path,
          .whole = view.tree(file)[symbol.node].span(),
          .where = symbol.where};
}

CallItem item_of_file(const SceneView& view, std::uint32_t file) {
  const fs::path& path = view.module(file).path;
  return {
      .is_file = true, .name = path.filename().string(), .path = path, .whole = {}, .where = {}};
}

/// The fns and defs of a file, in the order of the text.
std::vector<const Symbol*> callables_of(const SymbolTable& table) {
  std::vector<const Symbol*> found;
  for (const Symbol& symbol : table.symbols()) {
    if (is_callable(symbol)) found.push_back(&symbol);
  }
  return found;
}

/// The innermost one whose declaration contains the place; null for the top level.
const Symbol* callable_around(const SyntaxTree& tree, const std::vector<const Symbol*>& callables,
                              Span place) {
  const auto after = std::ranges::upper_bound(callables, place.begin, {},
                                              [&](const Symbol* s) { return tree[s->node].begin; });
  // Definitions may be nested: those that end before the place are skipped.
  for (auto before = after; before != callables.begin();) {
    const Symbol* callable = *--before;
    if (place.end <= tree[callable->node].end) return callable;
    if (!callable->is_local) break;  // no other contains the place
  }
  return nullptr;
}

/// Collects places by the item at the other end.
class Groups {
 public:
  void add(const CallItem& item, const std::vector<Span>& calls) {
    auto& [known, places] =
        groups_.try_emplace({item.path, item.where.begin, item.is_file ? 0 : 1}).first->second;
    known = item;
    places.insert(places.end(), calls.begin(), calls.end());
  }

  std::vector<CallGroup> take() {
    std::vector<CallGroup> all;
    for (auto& [key, group] : groups_) all.push_back(std::move(group));
    return all;
  }

 private:
  std::map<std::tuple<fs::path, std::uint32_t, int>, CallGroup> groups_;
};

}  // namespace

std::optional<CallItem> call_item_at(const SceneView& view, std::uint32_t file,
                                     std::uint32_t offset) {
  const SymbolId id = view.index().at(file, offset);
  const Symbol* symbol = view.index().find(id);
  if (symbol == nullptr || !is_callable(*symbol)) return std::nullopt;
  return item_of(view, id.file, *symbol);
}

std::vector<CallGroup> incoming_calls(SceneSet& scenes, const SharedSymbol& callee) {
  Groups groups;
  PlaceSet seen;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const SceneView* view = scenes.scene(i);
    if (view == nullptr) continue;
    const SymbolId id = symbol_in(*view, callee);
    std::vector<FileSpan> calls = view->index().references(id);
    std::erase(calls, FileSpan{id.file, callee.where});
    std::map<std::uint32_t, std::vector<const Symbol*>> callables;  // by file
    std::map<std::pair<std::uint32_t, const Symbol*>, std::vector<Span>> by_caller;
    for (const FileSpan& call : seen.add(*view, calls)) {
      const auto [known, is_new] = callables.try_emplace(call.file);
      if (is_new) known->second = callables_of(view->table(call.file));
      const Symbol* caller = callable_around(view->tree(call.file), known->second, call.span);
      by_caller[{call.file, caller}].push_back(call.span);
    }
    for (const auto& [caller, places] : by_caller) {
      const auto& [file, symbol] = caller;
      groups.add(symbol == nullptr ? item_of_file(*view, file) : item_of(*view, file, *symbol),
                 places);
    }
  }
  return groups.take();
}

std::vector<CallGroup> outgoing_calls(const SceneView& view, const CallItem& caller) {
  const auto file = view.find(caller.path);
  if (!file) return {};
  const SymbolTable& table = view.table(*file);
  const std::vector<const Symbol*> callables = callables_of(table);
  std::map<std::pair<std::uint32_t, const Symbol*>, std::vector<Span>> by_callee;
  for (const Occurrence& name : table.occurrences()) {
    const Symbol* callee = view.index().find(name.symbol);
    const bool is_call = callee != nullptr && is_callable(*callee) &&
                         !(name.symbol.file == *file && name.where == callee->where);
    if (!is_call) continue;
    const Symbol* around = callable_around(table.tree(), callables, name.where);
    const bool is_inside =
        around == nullptr ? caller.is_file : !caller.is_file && around->where == caller.where;
    if (is_inside) by_callee[{name.symbol.file, callee}].push_back(name.where);
  }
  Groups groups;
  for (const auto& [callee, places] : by_callee) {
    groups.add(item_of(view, callee.first, *callee.second), places);
  }
  return groups.take();
}

}  // namespace sdlc::lang
