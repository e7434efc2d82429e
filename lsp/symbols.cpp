#include "lsp/symbols.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/editor/symbol_search.hpp"
#include "lang/editor/symbols.hpp"
#include "lang/resolve/symbol.hpp"
#include "lsp/file_facts.hpp"
#include "lsp/positions.hpp"
#include "lsp/symbol_kinds.hpp"

namespace sdlc::lsp {
namespace {

std::vector<lang::DocumentSymbol> symbols_of(const Text& text) {
  return text.is_scene() ? lang::document_symbols(text.view->tree(text.file))
                         : lang::config_symbols(text.source->text());
}

/// Makes the JSON of symbols, each with those that are inside it.
class SymbolTree {
 public:
  SymbolTree(Session& session, const Text& text)
      : symbols_(symbols_of(text)),
        ranges_(*text.source, session.client().encoding()),
        knows_all_(session.client().can("/textDocument/documentSymbol/symbolKind")) {}

  /// DocumentSymbols: those from the next one on that are at least as deep.
  Json nested(std::uint32_t depth = 0) {
    Json list = Json::array();
    while (next_ < symbols_.size() && symbols_[next_].depth >= depth) {
      const lang::DocumentSymbol& symbol = symbols_[next_++];
      Json json = common(symbol);
      json["range"] = ranges_.range(symbol.whole);
      json["selectionRange"] = ranges_.range(symbol.where);
      if (!symbol.detail.empty()) json["detail"] = symbol.detail;
      if (Json children = nested(symbol.depth + 1); !children.empty()) {
        json["children"] = std::move(children);
      }
      list.push_back(std::move(json));
    }
    return list;
  }

  /// SymbolInformation of all, with the name of the symbol around each.
  Json flat(const std::string& uri) {
    Json list = Json::array();
    std::vector<const lang::DocumentSymbol*> around;
    for (const lang::DocumentSymbol& symbol : symbols_) {
      while (!around.empty() && around.back()->depth >= symbol.depth) around.pop_back();
      Json json = common(symbol);
      json["location"] = {{"uri", uri}, {"range", ranges_.range(symbol.whole)}};
      if (!around.empty()) json["containerName"] = around.back()->name;
      list.push_back(std::move(json));
      around.push_back(&symbol);
    }
    return list;
  }

 private:
  Json common(const lang::DocumentSymbol& symbol) const {
    return {{"name", symbol.name}, {"kind", symbol_number(symbol.icon, knows_all_)}};
  }

  std::vector<lang::DocumentSymbol> symbols_;
  TextRanges ranges_;
  bool knows_all_;
  std::size_t next_ = 0;
};

/// Symbols that are sent at most: an editor asks again when the query is longer.
constexpr std::size_t kMaxFound = 200;

/// SymbolInformation.
Json found_json(const Session& session, const FileFacts& file, const IndexedSymbol& symbol,
                bool knows_all) {
  Json json{
      {"name", symbol.name},
      {"kind", symbol_number(symbol.kind, knows_all)},
      {"location",
       {{"uri", session.uri_of(file.path)},
        {"range", {{"start", position_json(symbol.begin)}, {"end", position_json(symbol.end)}}}}}};
  if (!symbol.container.empty()) json["containerName"] = symbol.container;
  return json;
}

}  // namespace

Json list_document_symbols(Session& session, const Json& params) {
  const Text text = session.text_of(params);
  SymbolTree tree(session, text);
  const bool is_nested =
      session.client().can("/textDocument/documentSymbol/hierarchicalDocumentSymbolSupport");
  if (is_nested) return tree.nested();
  return tree.flat(document_uri(params));
}

Json find_workspace_symbols(Session& session, const Json& params) {
  const auto files = session.index().facts();
  lang::SymbolSearch search(params.value("query", ""), kMaxFound);
  for (std::size_t file = 0; file < files.size(); ++file) {
    lang::stop_if_requested(&session.stop());
    const std::vector<IndexedSymbol>& symbols = files[file]->symbols;
    for (std::size_t i = 0; i < symbols.size(); ++i) {
      // An import only repeats the name of a file.
      if (symbols[i].kind == lang::SymbolKind::Import) continue;
      search.add(symbols[i].name, std::uint64_t{file} << 32 | i);
    }
  }
  const bool knows_all = session.client().can("/workspace/symbol/symbolKind");
  Json found = Json::array();
  for (const std::uint64_t key : search.best()) {
    const FileFacts& file = *files[key >> 32];
    found.push_back(found_json(session, file, file.symbols[key & 0xFFFFFFFF], knows_all));
  }
  return found;
}

}  // namespace sdlc::lsp
