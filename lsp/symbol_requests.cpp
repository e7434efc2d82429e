#include "lsp/symbol_requests.hpp"

#include <string>
#include <utility>
#include <vector>

#include "lang/editor/symbols.hpp"
#include "lsp/place_ranges.hpp"
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
        ranges_(session, *text.source),
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

}  // namespace

Json list_document_symbols(Session& session, const Json& params) {
  const Text text = session.text_of(params);
  SymbolTree tree(session, text);
  const bool is_nested =
      session.client().can("/textDocument/documentSymbol/hierarchicalDocumentSymbolSupport");
  if (is_nested) return tree.nested();
  return tree.flat(params.at("textDocument").at("uri").get<std::string>());
}

}  // namespace sdlc::lsp
